#pragma once

/// The Newton method on nested grids: from a grid with a dozen nodes along the contact, halving the spacing, to the
/// one asked for. Windows follow the contact; where a level fails, safer starts are tried.

#include <functional>
#include <memory>

#include "core/newton_contact.hpp"

namespace rollres {

/// One grid with all that belongs to it.
struct ContactLevel {
  std::unique_ptr<ContactProblem> problem;
  std::unique_ptr<InfluenceTable> table;
  std::unique_ptr<InfluenceOperator> influence;
  NewtonOutcome outcome;
  double rolling_resistance = 0;
};

struct NestedOutcome {
  ContactLevel finest;
  /// Rolling resistance at twice the finest spacing; NaN if there was no coarser level.
  double coarser_resistance = RollingSolution::absent;
  Status status = Status::not_converged;
  std::string reason;
  double friction_needed = RollingSolution::absent;  // with no_steady_state
};

/// @param spacing of the finest grid [m]
/// @param finer asked after a level at the wanted spacing has converged: true to halve the spacing once more
NestedOutcome solve_nested(const RollingScene& scene, double spacing,
                           const std::function<bool(const NestedOutcome&)>& finer = {});

/// Friction coefficient at which sliding just gives the traction that the scene's drive asks for, on a given grid.
/// Infinite if no friction suffices.
double friction_needed(const RollingScene& scene, const SurfaceGrid& half_grid);

}  // namespace rollres
