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
  double share = 0;      ///< of the last change that is still to come, 0 to 1: 1 where changes halve twice running
  double to_come = 0;    ///< that share of it
  double last_step = 0;  ///< by which this limit differs from that of the grid before

  GridLimit() = default;
  /// @param most  of the share
  explicit GridLimit(const std::array<double, 4>& values, double most = 1);
};

/// @param coarser the three grids before, from the coarsest; fewer have no limit
GridLimit limit_of(const std::vector<GridNumbers>& coarser, const GridNumbers& finest, double GridNumbers::*number,
                   double most = 1);

/// An estimate of the error of a number where its limit is taken, by as much as it is.
/// @param estimate of the finest grid's own
double error_at_limit(const GridLimit& limit, double estimate);

}  // namespace rollres
