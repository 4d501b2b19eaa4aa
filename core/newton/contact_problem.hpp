#pragma once

/// The discretised contact problem: one row per law, on a grid of nodes that uses the scene's symmetry in y.
///
/// A sphere's problem is even in y, so only rows with y >= 0 are kept and rows with y > 0 count twice in sums; a
/// cylinder has a single row, which is whole: askew it has shear along its axle. Unknowns are the pressure p and the
/// shear tractions on the nodes in contact, the approach d and the rotation ratio omega = R Omega / V;
/// core/newton/README.md, (N1) to (N6), has their laws (Zehil and Gavin 2013, eqs. 12, 17, 19, 21, 25, 26, 31 with the
/// corrections of README.md).

#include <Eigen/Core>

#include "core/edge/contact_edge.hpp"
#include "core/model/indenter_shape.hpp"
#include "core/numerics/vector.hpp"
#include "core/scene/contact_state.hpp"
#include "core/scene/friction_law.hpp"

namespace rollres {

/// A linear functional of the tractions: sum(of_pressure * p) + sum(of_shear_x * tau_x); empty shear is none.
struct Resultant {
  Vector of_pressure, of_shear_x;
  double operator()(const Vector& pressure, const Vector& shear_x) const {
    return of_pressure.dot(pressure) + (shear_x.size() > 0 ? of_shear_x.dot(shear_x) : 0);
  }
};

struct ContactProblem {
  /// @param grid rows with y >= 0 only for a sphere, one row for a cylinder
  ContactProblem(const ContactModel& model, const SurfaceGrid& grid);

  ContactModel model;
  SurfaceGrid grid;
  IndenterShape shape;
  FrictionLaw law;
  bool friction, lateral;                 // shear; tractions and displacements along y
  bool plane;                             // rows in y, and not a line
  double sideways = 0;                    // rigid slip along y: -tan a of a skewed cylinder [1]
  Vector profile;                         // height of the body's lower surface above its lowest point [m]
  Vector forward, turning;                // of the slip (N2) as the law of friction takes it [1]
  Resultant load, torque, driving_force;  // (N3): P [N], T [N m], Q [N] (per metre for a cylinder)
  Resultant drive;                        // row that the drive sets to `drive_target`; unused with drive "rotation"
  double drive_target = 0;
  CoatingMoments of_coating;  // what a coating's M and N add to that row per unit; 0 without a row or a coating
  double idle_ratio = 1;      // R Omega/V without friction [1]
  EdgeSlip edge;              // none where it is not known

  /// Whether the contact's edge shall be sought inside the cells: with the paper's kinematics the grid is the paper's.
  bool follows_edge() const {
    return friction && plane && model.kinematics == Kinematics::consistent && model.adhesion_threshold == 0;
  }
  /// @param in_contact a flag for each node
  void take_edge(const EdgeCurve& curve, const std::vector<char>& in_contact) {
    edge = {model, grid, curve, in_contact};
  }

  bool load_given() const { return model.load.has_value(); }
  bool rotation_given() const { return model.drive == Drive::rotation; }
  bool coating_drives() const { return of_coating.pressed != 0; }
  double coating_in_drive(const CoatingMoments& moments) const {
    return of_coating.pressed * moments.pressed + of_coating.sheared * moments.sheared;
  }
  double drive_surplus(const Vector& pressure, const Vector& shear_x, const CoatingMoments& moments) const {
    return drive(pressure, shear_x) + coating_in_drive(moments) - drive_target;
  }
  /// Unknown tractions at a node in contact: p; tau_x; tau_y.
  int components() const { return !friction ? 1 : lateral ? 3 : 2; }
  /// How often a node of the half grid stands on the whole one.
  int images(Eigen::Index node) const { return grid.first_row + node / grid.columns == 0 ? 1 : 2; }
  /// Whether it has a shear along y: on the axis of symmetry there is none.
  bool sheared_across(Eigen::Index node) const { return lateral && (!plane || images(node) > 1); }
  /// s_x and s_y of a node, over what scales them in the law of friction, from du/dx or dv/dx and the law's ratio [1].
  double slip_x(Eigen::Index node, double slope_u, double law_ratio) const {
    return forward(node) + slope_u - law_ratio * turning(node);
  }
  double slip_y(double slope_v, double law_ratio) const {
    return sideways == 0 ? slope_v : sideways * shape.law_share(law_ratio) + slope_v;
  }
  /// Rotation ratio by which the torque counts in the resistance Q + omega T/R: without friction that of rolling, as
  /// the pressure must be overcome by one or the other, or at which the coating flows.
  double turning_ratio(double law_ratio) const {
    if (!friction) return idle_ratio;
    return rotation_given() ? *model.rotation_ratio : shape.rotation_ratio(law_ratio);
  }
  /// Force along the axle of a skewed cylinder [N/m].
  double axial_force(const Vector& shear_y) const {
    return plane || shear_y.size() == 0 ? 0 : grid.cell_area() * shear_y.sum();
  }
  /// Rolling resistance [N] (per metre for a cylinder) but for `sideways` times the axial force; empty shear is none.
  double resistance(const Vector& pressure, const Vector& shear_x, double law_ratio,
                    const CoatingMoments& coating) const {
    const double turning = turning_ratio(law_ratio);
    return driving_force(pressure, shear_x) + torque(pressure, shear_x) * turning / shape.radius() +
           shape.of_coating() * (turning * coating.in_torque() - coating.pressed);
  }
};

/// The whole grid of a half grid: rows mirrored to y < 0. A cylinder's single row stays.
SurfaceGrid mirrored(const SurfaceGrid& half);

/// Values on the whole grid from those on the half grid; `parity` -1 for odd in y.
Vector mirrored(const SurfaceGrid& half, const Vector& values, double parity);

}  // namespace rollres
