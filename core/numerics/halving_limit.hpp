#pragma once

/// The limit of a number on grids that are halved, where its error is of first order: changes halve, and one
/// extrapolation takes it away (core/newton/README.md, (N22c)).

#include <array>

namespace rollres {

struct HalvingLimit {
  double share = 0;    ///< of the last change that is still to come, 0 to 1: 1 where changes halve twice running
  double to_come = 0;  ///< that share of it
  double error = 0;    ///< of the full limit, estimated: its own last change, and a quarter of what was to come

  HalvingLimit() = default;
  /// @param values  on four grids, each of half the spacing of the one before   @param most  of the share
  explicit HalvingLimit(const std::array<double, 4>& values, double most = 1);

  /// What finer grids may still change where the limit is taken, by as much as it is.
  /// @param own  what they may change in the finest grid's own
  double change_left(double own) const { return (1 - share) * own + share * error; }
};

}  // namespace rollres
