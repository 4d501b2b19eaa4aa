#pragma once

/// Layers that flow through a mesh against a rigid cylinder, or a cover that does against a rigid plane: semi-smooth
/// Newton method for displacements, pressures and the laws of contact at once (core/finite_strain/README.md, sections
/// 4 to 6).

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/finite_strain/flowing_layer.hpp"
#include "core/model/contact_model.hpp"
#include "core/scene/friction_law.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

/// All unknowns on one mesh.
struct FiniteState {
  Vector unknowns;             // by Numbering: displacements, normal and, with friction, tangential forces of nodes
  Eigen::Matrix3Xd pressures;  // of the cells
  double approach = 0;         // d
  double rotation_ratio = 1;   // R Omega / V
};

/// A node of the surface against the rigid one, a circle or a plane.
struct SurfaceNode {
  double place = 0, share = 0;        // on the undeformed surface
  Eigen::Vector2d position, outward;  // where it is; normal of the rigid surface, out of it
  Eigen::Vector2d tangent;            // outward turned, along +x under the axis
  double distance = 0;                // from the circle's axis; infinite from a plane's
  double arc = 0, per_step = 1;       // where it is along the rigid surface; its derivative along `tangent`
  double gap = 0;
  double normal = 0, shear = 0;  // forces on it along `outward` and `tangent`
  double stretch = 1;            // of arc by place, between the node ahead and this one
  double slip = 0;               // (H11) of the rigid surface relative to it over V, by this stretch
  Zone zone = Zone::free;
  double direction = 0;  // of friction where it slips: 1 or -1
};

struct FiniteOutcome {
  bool converged = false;
  std::string reason;  // why not
  int steps = 0;
};

class FiniteContact {
 public:
  /// @param scene  a cylinder's, in units in which the contact is about 1 long and the modulus about 1
  FiniteContact(const ContactModel& model, FlowingLayer& layer);

  /// Improves a state until all equations and laws hold. Without friction the body's surface is taken as smooth.
  /// @param sticking  begins with all of the contact in stick, not as the state says
  FiniteOutcome solve(FiniteState& state, bool with_friction, bool sticking);

  /// The surface in the last state, from the leading end.
  const std::vector<SurfaceNode>& surface() const { return nodes_; }
  double load() const;            // P
  double driving_force() const;   // Q
  double torque() const;          // T
  double friction_power() const;  // over V
  /// What that may miss as each border between stick and slip is known to a node: slip begins there with 0, so that of
  /// a zone's power it is the square of the node's share of its length.
  double friction_power_missed() const;
  /// Whether it is the body's cover that flows.
  bool covered() const { return layer_.mesh().curvature > 0; }
  /// R_r = Q + Omega T/V
  double resistance() const { return driving_force() + rotation_ratio_ * torque() / model_.radius; }
  /// Slip over V of a node by the positions of its neighbours on both sides.
  double slip(std::size_t node) const;
  /// The largest violation of any law, in the scales of core/newton/grid_solution.hpp.
  double law_violation() const;

 private:
  struct Entry {
    Eigen::Index row, column;
    double value;
  };
  bool sheared() const { return layer_.numbering().extra > 1; }
  Eigen::Index size() const { return layer_.numbering().size(); }
  Eigen::Index normal(std::size_t node) const { return layer_.numbering().surface(static_cast<int>(node), 0); }
  Eigen::Index shear(std::size_t node) const { return layer_.numbering().surface(static_cast<int>(node), 1); }
  Eigen::Index displacement(std::size_t node) const { return layer_.numbering().node(static_cast<int>(node), 0); }

  double slip_at(double stretch) const { return covered() ? rotation_ratio_ * stretch - 1 : stretch - rotation_ratio_; }
  double lever(const SurfaceNode& node) const { return node.position.y() + model_.radius; }
  void place_nodes(const FiniteState& state);
  void linearise_drive(std::size_t node);
  bool choose_zones();
  Vector residual() const;
  void linearise();
  void add(Eigen::Index row, Eigen::Index column, double value) { entries_.push_back({row, column, value}); }
  void add_along_tangent(Eigen::Index row, std::size_t node, double factor);
  Vector multiply(const Vector& change) const;
  void prepare();
  Vector precondition(const Vector& right_side) const;
  /// Adds as much of a change as folds no cell. @return that part, 0 if there is none
  double step(const Vector& change, FiniteState& state, FiniteOutcome& outcome);
  double left(const Vector& missing) const;

  const ContactModel& model_;
  FrictionLaw law_;
  FlowingLayer& layer_;
  bool with_friction_ = false;
  double approach_ = 0, rotation_ratio_ = 1;
  std::vector<SurfaceNode> nodes_;
  std::vector<Entry> entries_;
  BlockTridiagonal local_;
  Eigen::Matrix<double, Eigen::Dynamic, 2> border_columns_, solved_columns_;
  Eigen::Matrix<double, 2, Eigen::Dynamic> border_rows_;
  Eigen::Matrix2d corner_, corner_inverse_;
};

}  // namespace rollres
