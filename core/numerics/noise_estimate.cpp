#include "core/numerics/noise_estimate.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/numerics/finite_difference.hpp"

namespace rollres {

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
