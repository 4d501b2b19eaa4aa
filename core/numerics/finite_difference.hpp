#pragma once

/// Formulas for derivatives from values at given points.

#include <cstddef>
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

}  // namespace rollres
