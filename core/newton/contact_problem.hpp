#pragma once

/// The discretised contact problem: one row per law, on a grid of nodes that uses the scene's symmetry in y.
///
/// A sphere's problem is even in y, so only rows with y >= 0 are kept and rows with y > 0 count twice in sums; a
/// cylinder has a single row. Unknowns are the pressure p and the shear tractions on the nodes in contact, the
/// approach d and the rotation ratio omega = R Omega / V; core/newton/README.md, (N1) to (N6), has their laws (Zehil
/// and Gavin 2013, eqs. 12, 17, 19, 21, 25, 26, 31 with the corrections of README.md).

#include <Eigen/Core>

#include "core/numerics/vector.hpp"
#include "core/scene/contact_state.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

/// A linear functional of the tractions: sum(of_pressure * p) + sum(of_shear_x * tau_x).
struct Resultant {
  Vector of_pressure, of_shear_x;
  double operator()(const Vector& pressure, const Vector& shear_x) const {
    return of_pressure.dot(pressure) + of_shear_x.dot(shear_x);
  }
};

struct ContactProblem {
  /// @param grid rows with y >= 0 only for a sphere, one row for a cylinder
  ContactProblem(const RollingScene& scene, const SurfaceGrid& grid);

  RollingScene scene;
  SurfaceGrid grid;
  bool sphere, friction;
  Vector profile;                         // height of the body's lower surface above its lowest point [m]
  Vector rolling_radius;                  // R(y)/R [1]
  Resultant load, torque, driving_force;  // (N3): P [N], T [N m], Q [N] (per metre for a cylinder)
  Resultant drive;                        // row that the drive sets to `drive_target`; unused with drive "rotation"
  double drive_target = 0;

  bool load_given() const { return scene.load.has_value(); }
  bool rotation_given() const { return scene.drive == Drive::rotation; }
};

/// The whole grid of a half grid: rows mirrored to y < 0 for a sphere.
SurfaceGrid mirrored(const SurfaceGrid& half, bool sphere);

/// Values on the whole grid from those on the half grid; `parity` -1 for odd in y.
Vector mirrored(const SurfaceGrid& half, bool sphere, const Vector& values, double parity);

}  // namespace rollres
