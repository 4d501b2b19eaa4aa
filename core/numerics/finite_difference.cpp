#include "core/numerics/finite_difference.hpp"

#include <cassert>
#include <cmath>

namespace rollres {

std::vector<double> first_derivative_weights(std::span<const double> offsets) {
  assert(offsets.size() >= 2);
  std::vector<double> weights;
  for (std::size_t j = 0; j < offsets.size(); ++j) {
    double weight = 0;
    for (std::size_t m = 0; m < offsets.size(); ++m) {
      if (m == j) continue;
      double product = 1 / (offsets[j] - offsets[m]);
      for (std::size_t l = 0; l < offsets.size(); ++l)
        if (l != j && l != m) product *= -offsets[l] / (offsets[j] - offsets[l]);
      weight += product;
    }
    weights.push_back(weight);
  }
  return weights;
}

DividedDifferences divided_differences(std::span<const double> points, std::span<const double> values,
                                       std::size_t order) {
  assert(points.size() == values.size() && order >= 1 && order < values.size());
  DividedDifferences differences;
  for (std::size_t first = 0; first + order < values.size(); ++first) {
    double value = 0, squares = 0;
    for (std::size_t j = first; j <= first + order; ++j) {
      double weight = 1;
      for (std::size_t l = first; l <= first + order; ++l)
        if (l != j) weight /= points[j] - points[l];
      value += weight * (values[j] - values[first]);
      squares += weight * weight;
    }
    differences.values.push_back(value);
    differences.norms.push_back(std::sqrt(squares));
  }
  return differences;
}

}  // namespace rollres
