#include "core/numerics/finite_difference.hpp"

#include <algorithm>
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

NoiseEstimate estimate_noise(std::span<const double> points, std::span<const double> values) {
  assert(values.size() >= 5 && points.size() == values.size());
  constexpr double agreement = 4;
  NoiseEstimate estimate;
  std::vector<bool> sign_changes;
  for (std::size_t order = 1; order < values.size(); ++order) {
    const DividedDifferences differences = divided_differences(points, values, order);
    const std::vector<double>& value = differences.values;
    if (order == 1 && 2 * std::count(value.begin(), value.end(), 0.0) >= std::ssize(value)) {
      estimate.outcome = NoiseOutcome::spacing_too_small;
      return estimate;
    }
    double squares = 0;
    for (std::size_t i = 0; i < value.size(); ++i) squares += std::pow(value[i] / differences.norms[i], 2);
    estimate.levels.push_back(std::sqrt(squares / static_cast<double>(value.size())));
    const auto [least, most] = std::minmax_element(value.begin(), value.end());
    sign_changes.push_back(*least < 0 && *most > 0);
  }
  for (std::size_t k = 0; k + 2 < estimate.levels.size(); ++k) {
    const auto [least, most] = std::minmax({estimate.levels[k], estimate.levels[k + 1], estimate.levels[k + 2]});
    if (!sign_changes[k] || most > agreement * least) continue;
    estimate.outcome = NoiseOutcome::found;
    estimate.noise = most;
    break;
  }
  return estimate;
}

}  // namespace rollres
