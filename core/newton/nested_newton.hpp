#pragma once

/// The Newton method on nested grids (grid_series.hpp). Windows follow the contact; where a level fails, safer starts
/// are tried.

#include <functional>

#include "core/newton/grid_series.hpp"
#include "core/numerics/halving_limit.hpp"

namespace rollres {

/// Of one grid: R_r and the side force (ContactProblem), and R Omega/V [1].
struct GridNumbers {
  double resistance = 0, rotation_ratio = 0, side_force = 0, load = 0;
};

struct NestedOutcome {
  ContactLevel finest;
  bool tied = false;                 // as the series of grids (grid_series.hpp)
  std::vector<GridNumbers> coarser;  // of the grids before, each of twice the spacing of the next; three at most
  double change_before = RollingSolution::absent;  // what R_r was expected to change on the last of them; NaN: unknown
  double last_change() const;                      // of R_r; NaN without a coarser grid [N]
  double last_change_of_load() const;              // relative; 0 without one [1]
  GridNumbers numbers() const;                     // of the finest
  /// What one of them tends to: where friction decides, the half cell between the law's slip and its traction leaves an
  /// error that halves with the spacing of tied grids. Less so where slow rolling takes their place.
  HalvingLimit limit(double GridNumbers::*number) const;
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
