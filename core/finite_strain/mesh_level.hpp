#pragma once

/// One mesh and the answer on it; its contact's edges, for which the next mesh is made.

#include <memory>
#include <vector>

#include "core/finite_strain/finite_newton.hpp"

namespace rollres {

/// A scene in units of a half-width and of the modulus at rest, as meshes take it.
struct FiniteProblem {
  explicit FiniteProblem(const ContactModel& given);

  double length = 1, modulus = 1;  // the units [m], [Pa]
  ContactModel model;
  bool covered = false;  // it is the body's cover that flows
  std::vector<FlowingMaterial> materials;
  std::vector<double> thicknesses;
  double approach = 0;  // where to start
};

struct ContactEdges {
  double trailing = -1.1, leading = 1.1;  // on the undeformed surface
};

class MeshLevel {
 public:
  /// @param edges  of the contact as known before
  MeshLevel(const FiniteProblem& problem, const ContactEdges& edges, int cells);

  /// Solves from the answer on another mesh, or from rest.
  FiniteOutcome solve(const MeshLevel* start);

  const FiniteContact& contact() const { return contact_; }
  const FlowingLayer& layer() const { return layer_; }
  const FiniteState& state() const { return state_; }
  int cells() const { return cells_; }
  /// Where the square of the pressure ends.
  ContactEdges edges() const;
  /// Where a place of the surface has moved to.
  Eigen::Vector2d moved(double place) const;
  /// Normal and tangential force over deformed length where cells meet in the contact, from the leading edge on. The
  /// forces of nodes scatter between corners and middles of cells; those of cells do not, and their sum is a smooth
  /// function of the angle in which the cells are equal: its derivative by five of them.
  struct Traction {
    double place, pressure, shear;
  };
  std::vector<Traction> tractions() const;

 private:
  void take_over(const MeshLevel& from);
  std::vector<double> summed(double SurfaceNode::*force) const;
  int first_cell() const;
  double density(const std::vector<double>& sums, int corner) const;

  const FiniteProblem& problem_;
  ContactEdges given_;
  int cells_;
  FlowingLayer layer_;
  FiniteContact contact_;
  FiniteState state_;
};

}  // namespace rollres
