#pragma once

/// What numbers of tied grids tend to (core/newton/README.md, (N22c)): where friction decides, the half cell between
/// the law's slip and its traction leaves an error that halves with the spacing, and one extrapolation takes it away.

#include <array>
#include <vector>

namespace rollres {

/// Of one grid: R_r and the axial force [N/m], and R Omega/V [1].
struct GridNumbers {
  double resistance = 0, rotation_ratio = 0, axial_force = 0;
};

/// A number of four grids, each of half the spacing of the one before.
struct GridLimit {
  double share = 0;    ///< of the last change that is still to come, 0 to 1: 1 where changes halve twice running
  double to_come = 0;  ///< that share of it
  double error = 0;    ///< of the full limit, estimated: its own last change, and a quarter of what was to come

  GridLimit() = default;
  /// @param most  of the share
  explicit GridLimit(const std::array<double, 4>& values, double most = 1);
};

/// @param coarser the three grids before, from the coarsest; fewer have no limit
GridLimit limit_of(const std::vector<GridNumbers>& coarser, const GridNumbers& finest, double GridNumbers::*number,
                   double most = 1);

/// What finer grids may still change in a number whose limit is taken, by as much as it is.
/// @param change  that they may in the finest grid's own
double change_at_limit(const GridLimit& limit, double change);

}  // namespace rollres
