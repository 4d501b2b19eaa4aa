#include "core/derivatives/gradient.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/messages/require.hpp"
#include "core/numerics/finite_difference.hpp"
#include "core/numerics/parallel.hpp"

namespace rollres {

namespace {

constexpr double smallest_step = 1e-7, largest_step = 0.1;
constexpr double deviations = 3;  // of the noise that an error estimate covers

/// Offsets in units of the step; none: there is no such formula.
std::vector<double> offsets_of(Scheme scheme, int order) {
  if (scheme == Scheme::none || (scheme == Scheme::central && order == 1)) return {};
  if (scheme == Scheme::central) return order == 2 ? std::vector<double>{-1, 1} : std::vector<double>{-2, -1, 1, 2};
  std::vector<double> offsets;
  for (int i = 0; i <= order; ++i) offsets.push_back(scheme == Scheme::forward ? i : -i);
  return offsets;
}

struct FormulaError {
  double truncation = 0, noise = 0;
};

/// What a formula errs by, over the noise and over the derivatives of a function.
struct FormulaSize {
  double norm = 0;                  // |w|
  std::array<double, 4> moments{};  // |sum_j w_j o_j^k| / k!, k = 2 to 5

  FormulaSize(const std::vector<double>& weights, const std::vector<double>& offsets) {
    for (std::size_t j = 0; j < weights.size(); ++j) {
      const double o = offsets[j], term = weights[j] * o * o;
      norm += weights[j] * weights[j];
      moments[0] += term / 2;
      moments[1] += term * o / 6;
      moments[2] += term * o * o / 24;
      moments[3] += term * o * o * o / 120;
    }
    norm = std::sqrt(norm);
    for (double& moment : moments) moment = std::abs(moment);
    if (offsets.size() > 2) moments[0] = 0;  // but for rounding
  }

  /// Of the formula with all offsets multiplied by `step` [output / scaled variable].
  FormulaError error(double step, const InputCalibration& known) const {
    const auto& bounds = known.derivatives;
    double truncation = 0;
    for (std::size_t k = moments.size(); k-- > 0;)
      truncation = step * (truncation + (moments[k] > 0 ? moments[k] * bounds[k] : 0));
    return {truncation, known.noise * norm / step};
  }
};

struct Formula {
  Scheme scheme = Scheme::none;
  double step = 0;
  double expected_error = 0;
};

/// The step with the smallest error up to `limit`; where nothing is known that is `limit`.
Formula best_formula(Scheme scheme, int order, const InputCalibration& known, double limit) {
  const std::vector<double> offsets = offsets_of(scheme, order);
  const FormulaSize size(first_derivative_weights(offsets), offsets);
  Formula best{scheme, limit, std::numeric_limits<double>::infinity()};
  constexpr double ratio = 1.2;
  for (double step = limit; step >= std::min(limit, smallest_step); step /= ratio) {
    const FormulaError error = size.error(step, known);
    if (error.truncation + error.noise < best.expected_error) best = {scheme, step, error.truncation + error.noise};
  }
  return best;
}

/// Formulas inside the room, with steps up to `limit`, the best first.
std::vector<Formula> formulas(const SampledLine& line, int order, const InputCalibration& known, double limit) {
  std::vector<Formula> found;
  for (const Scheme scheme : {Scheme::central, Scheme::forward, Scheme::backward}) {
    const std::vector<double> units = offsets_of(scheme, order);
    if (units.empty()) continue;
    const auto [lowest, highest] = std::minmax_element(units.begin(), units.end());
    double room = limit;
    if (*lowest < 0) room = std::min(room, line.room_below() / -*lowest);
    if (*highest > 0) room = std::min(room, line.room_above() / *highest);
    if (room > 0) found.push_back(best_formula(scheme, order, known, room));
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Formula& a, const Formula& b) { return a.expected_error < b.expected_error; });
  return found;
}

/// True if all points of the formula have values.
bool apply(const Formula& formula, int order, SampledLine& line, const InputCalibration& known, InputGradient& answer) {
  std::vector<double> offsets, differences;
  for (const double unit : offsets_of(formula.scheme, order)) {
    const auto sample = line.at(std::clamp(unit * formula.step, -line.room_below(), line.room_above()));
    if (!sample) return false;
    offsets.push_back(sample->offset);
    differences.push_back(sample->value - line.centre_value());
  }
  const std::vector<double> weights = first_derivative_weights(offsets);
  double derivative = 0;
  for (std::size_t j = 0; j < weights.size(); ++j) derivative += weights[j] * differences[j];
  const FormulaError error = FormulaSize(weights, offsets).error(1, known);
  const double input = line.centre_input(), slope = line.variable().slope(input);
  answer.derivative = derivative / slope;
  if (input != 0 && line.centre_value() != 0) answer.elasticity = answer.derivative * input / line.centre_value();
  answer.truncation_error = error.truncation / slope;
  answer.noise_error = deviations * error.noise / slope;
  answer.step = formula.step;
  answer.scheme = formula.scheme;
  return true;
}

InputGradient derivative_along(SampledLine line, int order, const InputCalibration& known) {
  InputGradient answer;
  constexpr int attempts = 4;
  constexpr double shrinking = 4;
  double limit = largest_step;
  for (int attempt = 0; attempt < attempts && answer.scheme == Scheme::none; ++attempt) {
    const std::vector<Formula> candidates = formulas(line, order, known, limit);
    for (const Formula& formula : candidates)
      if (apply(formula, order, line, known, answer)) break;
    if (candidates.empty()) break;
    limit = candidates.front().step / shrinking;
  }
  answer.evaluations = line.evaluations();
  answer.failures = line.failures();
  return answer;
}

}  // namespace

bool Gradient::complete() const {
  return centre.found() && std::all_of(inputs.begin(), inputs.end(),
                                       [](const InputGradient& input) { return input.scheme != Scheme::none; });
}

int Gradient::evaluations() const {
  int sum = 0;
  for (const InputGradient& input : inputs) sum += input.evaluations;
  return sum;
}

Gradient gradient(const Objective& objective, std::span<const double> point, const Calibration& calibration,
                  const GradientOptions& options) {
  require_inside(objective, point);
  require(options.order == 1 || options.order == 2 || options.order == 4, "order", options.order, "must be 1, 2 or 4");
  Gradient answer{{point.begin(), point.end()}, calibration.centre, {}};
  answer.inputs.resize(point.size());
  if (answer.point != calibration.point || !answer.centre.found()) answer.centre = value_at(objective, point);
  if (!answer.centre.found()) return answer;
  for_each_piece(point.size(), options.jobs, [&](std::size_t input) {
    answer.inputs[input] = derivative_along(SampledLine(objective, point, input, answer.centre.value), options.order,
                                            calibration.inputs.at(input));
  });
  return answer;
}

}  // namespace rollres
