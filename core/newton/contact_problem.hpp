#pragma once

/// The discretised contact problem: one row per law, on a grid of nodes that uses the scene's symmetry in y.
///
/// A straight sphere's problem is even in y, so only rows with y >= 0 are kept and rows with y > 0 count twice in sums:
/// its grid is folded. Of any other motion the grid is whole. A cylinder has a single row: askew it has shear along its
/// axle. Unknowns are the pressure p and the
/// shear tractions on the nodes in contact, the approach d and the rotation ratio omega = R Omega / V;
/// core/newton/README.md, (N1) to (N6), has their laws (Zehil and Gavin 2013, eqs. 12, 17, 19, 21, 25, 26, 31 with the
/// corrections of README.md).

#include <Eigen/Core>
#include <vector>

#include "core/edge/contact_edge.hpp"
#include "core/model/indenter_shape.hpp"
#include "core/numerics/vector.hpp"
#include "core/scene/contact_state.hpp"
#include "core/scene/friction_law.hpp"

namespace rollres {

/// A linear functional of the tractions: sum(of_pressure * p) + sum(of_shear_x * tau_x) + sum(of_shear_y * tau_y);
/// empty shear is none.
struct Resultant {
  Vector of_pressure, of_shear_x, of_shear_y;
  double operator()(const Vector& pressure, const Vector& shear_x, const Vector& shear_y) const {
    return of_pressure.dot(pressure) + (shear_x.size() > 0 ? of_shear_x.dot(shear_x) : 0) +
           (shear_y.size() > 0 ? of_shear_y.dot(shear_y) : 0);
  }
};

struct ContactProblem {
  /// @param grid folded if the model is mirrored; one row for a cylinder
  ContactProblem(const ContactModel& model, const SurfaceGrid& grid);

  ContactModel model;
  SurfaceGrid grid;
  IndenterShape shape;
  FrictionLaw law;
  bool friction, lateral;                 // shear; tractions and displacements along y
  bool plane;                             // rows in y, and not a line
  bool smooth_edge;                       // as has_smooth_edge (grid_choice.hpp) says
  Vector profile;                         // height of the body's lower surface above its lowest point [m]
  Vector forward, turning;                // of the slip (N2) as the law of friction takes it, along x [1]
  Vector forward_y, turning_y;            // and along y
  Resultant load, torque, driving_force;  // (N3): P [N], T [N m], Q [N] (per metre for a cylinder)
  Resultant resisting;                    // Q and what else than T the motion resists with [N]
  Resultant drive;                        // row that the drive sets to `drive_target`; unused with drive "rotation"
  double drive_target = 0;
  CoatingMoments of_coating;  // what a coating's M and N add to that row per unit; 0 without a row or a coating
  double idle_ratio = 1;      // R Omega/V without friction [1]
  EdgeSlip edge;              // none where it is not known

  /// Whether the contact's edge shall be sought inside the cells: with the paper's kinematics the grid is the
  /// paper's.
  bool follows_edge() const {
    return friction && plane && model.kinematics == Kinematics::consistent && model.adhesion_threshold == 0 &&
           smooth_edge;
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
  double drive_surplus(const Vector& pressure, const Vector& shear_x, const Vector& shear_y,
                       const CoatingMoments& moments) const {
    return drive(pressure, shear_x, shear_y) + coating_in_drive(moments) - drive_target;
  }
  /// Unknown tractions at a node in contact: p; tau_x; tau_y.
  int components() const { return !friction ? 1 : lateral ? 3 : 2; }
  /// How often a node of the grid stands on the whole one.
  int images(Eigen::Index node) const { return grid.images(static_cast<int>(node / grid.columns)); }
  /// Whether it has a shear along y: on the axis of symmetry there is none.
  bool sheared_across(Eigen::Index node) const { return lateral && (!grid.folded || images(node) > 1); }
  /// s_x and s_y of a node, over what scales them in the law of friction, from du/dx or dv/dx and the law's ratio [1].
  double slip_x(Eigen::Index node, double slope_u, double law_ratio) const {
    return forward(node) + slope_u - law_ratio * turning(node);
  }
  double slip_y(Eigen::Index node, double slope_v, double law_ratio) const {
    return forward_y(node) + slope_v - law_ratio * turning_y(node);
  }
  /// Rotation ratio by which the torque counts in the resistance Q + omega T/R: without friction that of rolling, as
  /// the pressure must be overcome by one or the other, or at which the coating flows.
  double turning_ratio(double law_ratio) const {
    if (!friction) return idle_ratio;
    return rotation_given() ? *model.rotation_ratio : shape.rotation_ratio(law_ratio);
  }
  /// Sum of a body's arms times the tractions; empty shear is none. @param arm of the shape, at x and y
  template <class Arm>
  double sum_of(const Vector& pressure, const Vector& shear_x, const Vector& shear_y, const Arm& arm) const {
    double sum = 0;
    for (Eigen::Index i = 0; i < pressure.size(); ++i) {
      if (pressure(i) == 0) continue;
      const LeverArm here = arm(grid.x(static_cast<int>(i % grid.columns)), grid.y(static_cast<int>(i / grid.columns)));
      double force = here.of_pressure * pressure(i);
      if (shear_x.size() > 0) force += here.of_shear_x * shear_x(i);
      if (shear_y.size() > 0) force += here.of_shear_y * shear_y(i);
      sum += grid.cell_area() * force;
    }
    return sum;
  }
  /// Force along the axle of a skewed cylinder [N/m], or along y on a sphere that is not mirrored [N].
  double side_force(const Vector& pressure, const Vector& shear_x, const Vector& shear_y) const {
    if (grid.folded || !lateral) return 0;
    return sum_of(pressure, shear_x, shear_y, [&](double x, double y) { return shape.side_force(x, y); });
  }
  /// Rolling resistance [N] (per metre for a cylinder); empty shear is none.
  double resistance(const Vector& pressure, const Vector& shear_x, const Vector& shear_y, double law_ratio,
                    const CoatingMoments& coating) const {
    const double turning = turning_ratio(law_ratio);
    return resisting(pressure, shear_x, shear_y) + torque(pressure, shear_x, shear_y) * turning / shape.radius() +
           shape.of_coating() * (turning * coating.in_torque() - coating.pressed);
  }
};

/// The whole grid of a folded one: rows mirrored to y < 0. A whole grid and a cylinder's single row stay.
SurfaceGrid mirrored(const SurfaceGrid& grid);

/// Values on the whole grid from those on the grid; `parity` -1 for odd in y.
Vector mirrored(const SurfaceGrid& grid, const Vector& values, double parity);
/// The same as a list.
std::vector<double> on_whole_grid(const SurfaceGrid& grid, const Vector& values, double parity);

/// Displacements at the nodes of the grid, of those that reach a column beyond it.
Vector at_nodes(const SurfaceGrid& grid, const Vector& moved);

}  // namespace rollres
