#pragma once

/// Noise of a computed function: rounding, iterations that stop early, grids that change.

#include <limits>
#include <span>
#include <vector>

namespace rollres {

enum class NoiseOutcome {
  found,
  spacing_too_small,  ///< half of the neighbours are equal: the points do not tell noise from its absence
  spacing_too_large   ///< the differences still fall from order to order: they are those of a smooth function
};

struct NoiseEstimate {
  NoiseOutcome outcome = NoiseOutcome::spacing_too_large;
  double noise = std::numeric_limits<double>::quiet_NaN();  ///< standard deviation [unit of the values], if found
  std::vector<double> levels;  ///< sigma_1, sigma_2, ...: the noise if all differences of this order were noise
};

/// Estimates the noise from values on a line (Moré and Wild 2011, SIAM J. Sci. Comput. 33, 1292, algorithm ECnoise,
/// here with divided differences, so that the points need not be equally spaced: those that are cannot see what has
/// their period). The k-th differences, over the norm of their weights, have the deviation of independent noise, while
/// those of a smooth function fall with the k-th power of the spacing. The noise is read at the first order k whose
/// differences change sign and whose sigma_k agrees with the next two within a factor of 4; it is the largest of the
/// three. With 7 values it is within a factor of 3 in about 95 of 100 tables.
/// @param points increasing
/// @param values as many, at least 5, all finite; 7 to 9 make a good estimate
NoiseEstimate estimate_noise(std::span<const double> points, std::span<const double> values);

}  // namespace rollres
