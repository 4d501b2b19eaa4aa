#include "core/derivatives/formula.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/finite_difference.hpp"

namespace rollres {

FormulaSize::FormulaSize(const std::vector<double>& weights, const std::vector<double>& offsets) {
  for (std::size_t j = 0; j < offsets.size(); ++j) {
    const double o = offsets[j], term = weights[j] * o * o;
    norm_ += weights[j] * weights[j];
    moments_[0] += term / 2;
    moments_[1] += term * o / 6;
    moments_[2] += term * o * o / 24;
    moments_[3] += term * o * o * o / 120;
  }
  norm_ = std::sqrt(norm_);
  for (double& moment : moments_) moment = std::abs(moment);
  if (offsets.size() > 2) moments_[0] = 0;  // but for rounding
}

FormulaError FormulaSize::error(double step, const FunctionSize& known) const {
  double truncation = 0;
  for (std::size_t k = moments_.size(); k-- > 0;)
    truncation = step * (truncation + (moments_[k] > 0 ? moments_[k] * known.derivatives[k] : 0));
  return {truncation, known.noise * norm_ / step};
}

std::vector<double> offsets_of(Scheme scheme, int order) {
  if (scheme == Scheme::none || (scheme == Scheme::central && order == 1)) return {};
  if (scheme == Scheme::central) return order == 2 ? std::vector<double>{-1, 1} : std::vector<double>{-2, -1, 1, 2};
  std::vector<double> offsets;
  for (int i = 0; i <= order; ++i) offsets.push_back(scheme == Scheme::forward ? i : -i);
  return offsets;
}

namespace {

constexpr double smallest_step = 1e-7;

/// The step with the smallest error up to `limit`; where nothing is known that is `limit`.
DifferenceFormula best_formula(Scheme scheme, const std::vector<double>& offsets, const FunctionSize& known,
                               double limit) {
  const FormulaSize size(first_derivative_weights(offsets), offsets);
  DifferenceFormula best{scheme, limit, std::numeric_limits<double>::infinity()};
  constexpr double ratio = 1.2;
  for (double step = limit; step >= std::min(limit, smallest_step); step /= ratio) {
    const FormulaError error = size.error(step, known);
    if (error.truncation + error.noise < best.expected_error) best = {scheme, step, error.truncation + error.noise};
  }
  return best;
}

}  // namespace

std::vector<DifferenceFormula> formulas(int order, const FunctionSize& known, double limit, double room_below,
                                        double room_above) {
  std::vector<DifferenceFormula> found;
  for (const Scheme scheme : {Scheme::central, Scheme::forward, Scheme::backward}) {
    const std::vector<double> units = offsets_of(scheme, order);
    if (units.empty()) continue;
    const auto [lowest, highest] = std::minmax_element(units.begin(), units.end());
    double room = limit;
    if (*lowest < 0) room = std::min(room, std::min(room_below, known.reach) / -*lowest);
    if (*highest > 0) room = std::min(room, std::min(room_above, known.reach) / *highest);
    if (room > 0) found.push_back(best_formula(scheme, units, known, room));
  }
  std::stable_sort(found.begin(), found.end(), [](const DifferenceFormula& a, const DifferenceFormula& b) {
    return a.expected_error < b.expected_error;
  });
  return found;
}

}  // namespace rollres
