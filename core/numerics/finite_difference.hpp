#pragma once

/// What values at given points tell of a computed function: derivatives, and its noise (rounding, iterations that stop
/// early, grids that change).

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace rollres {

/// Weights w_j such that sum_j w_j f(o_j) is f'(0) for every polynomial of a degree below the number of offsets
/// (Fornberg 1988, Math. Comp. 51, 699, by Lagrange's form).
/// @param offsets distinct, at least two
std::vector<double> first_derivative_weights(std::span<const double> offsets);

/// The divided differences of one order: of all neighbours in a table, f[x_i, ..., x_{i+order}], which is
/// f^(order) / order! somewhere between them.
struct DividedDifferences {
  std::vector<double> values;
  std::vector<double> norms;  ///< of their weights: their deviation for values with independent noise of deviation 1
};

/// @param points distinct   @param values as many   @param order at least 1, below their number
DividedDifferences divided_differences(std::span<const double> points, std::span<const double> values,
                                       std::size_t order);

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
