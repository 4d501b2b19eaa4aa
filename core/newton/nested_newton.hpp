#pragma once

/// The Newton method on nested grids (grid_series.hpp). Windows follow the contact; where a level fails, safer starts
/// are tried.

#include <functional>

#include "core/newton/grid_series.hpp"

namespace rollres {

struct NestedOutcome {
  ContactLevel finest;
  bool tied = false;  // as the series of grids (grid_series.hpp)
  /// Rolling resistance at twice the finest spacing, and what was expected to change there; NaN if there was no such
  /// level.
  double coarser_resistance = RollingSolution::absent, change_before = RollingSolution::absent;
  /// Estimated error of a rolling resistance [N] (core/newton/README.md, (N22)).
  double error_estimate(const GridError& error, double resistance) const;
  /// The same of what the finest grid itself says, relative; at least what the power balance misses, if that is much.
  double error_estimate() const;
  Status status = Status::not_converged;
  std::string reason;
  double friction_needed = RollingSolution::absent;  // with no_steady_state: too little friction for the drive,
  double friction_borne = RollingSolution::absent;   // or so much that the body digs itself in
};

/// Of two answers to a scene the one with the smaller estimate of its error, with the reason of the first why no more
/// was found. @param other may be none
NestedOutcome better_of(NestedOutcome answer, NestedOutcome other);

/// @param finer asked after the finest grid of the series has converged: true to halve the spacing once more, which
/// leaves what was found where it has no solution or a larger estimate of its error
NestedOutcome solve_nested(const ContactModel& model, const GridSeries& grids,
                           const std::function<bool(const NestedOutcome&)>& finer = {});

/// How much a grid's solution is worth.
enum class Effort {
  start,       ///< it gives a start, or an error: laws to `NewtonOptions::start_tolerance`
  refinement,  ///< there is an answer on a coarser grid already: laws to the tolerance, the quick starts only
  all          ///< without it there is no answer: every start, and the path of solutions over the rotation
};

/// Solves on one window, which grows until the contact keeps clear of its border.
/// @param coarser tried first if not null
ContactLevel solve_level(const ContactModel& model, SurfaceGrid grid, const ContactLevel* coarser, Effort effort);

}  // namespace rollres
