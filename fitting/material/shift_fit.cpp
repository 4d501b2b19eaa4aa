#include "fitting/material/shift_fit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/algebra/dense_algebra.hpp"
#include "fitting/material/material_problem.hpp"

namespace rollres {

namespace {

/// The constants of least squares where the law is linear: c1 (T - T0) + c2 log10 a = -(T - T0) log10 a for WLF, and
/// for VFT by those; ln a = E/R (1/T - 1/T0) for Arrhenius, with T0 where the factors are 1. In place of those that
/// make no sense usual ones.
TemperatureShift linear_shift(const std::vector<MeasuredShift>& data, TemperatureShift law, double relative_to) {
  const Eigen::Index rows = std::ssize(data);
  Eigen::MatrixXd a(rows, 2);
  Eigen::VectorXd b(rows), log_factor(rows), inverse(rows);
  double lowest = 0;
  for (Eigen::Index i = 0; i < rows; ++i) {
    const MeasuredShift& row = data[static_cast<std::size_t>(i)];
    const double above = row.temperature - relative_to, decades = std::log10(row.factor);
    a.row(i) << above, decades;
    b[i] = -above * decades;
    log_factor[i] = std::log(row.factor);
    inverse[i] = 1 / row.temperature - 1 / relative_to;
    lowest = std::min(lowest, above);
  }
  constexpr double gas_constant = 8.31446261815324;  // [J/(mol K)]
  if (law.law == ShiftLaw::arrhenius) {
    law.activation_energy = std::max(0.0, gas_constant * inverse.dot(log_factor) / inverse.squaredNorm());
    return law;
  }
  const Eigen::VectorXd constants = least_squares(a, b);
  constexpr double farther = 1.05;                   // than the lowest temperature lies the pole
  const double moved = law.reference - relative_to;  // of another reference: c1 c2 and T0 - c2 are the same
  const bool sound = constants[0] > 0 && constants[1] > -farther * std::min(lowest, moved);
  const double c1 = sound ? constants[0] : 8.86,
               c2 = sound ? constants[1] : std::max(101.6, -2 * std::min(lowest, moved));
  law.c2 = c2 + moved;
  law.c1 = c1 * c2 / law.c2;
  law.vft_temperature = std::max(1.0, relative_to - c2);
  law.vft_b = c1 * (relative_to - law.vft_temperature) * std::numbers::ln10;
  return law;
}

}  // namespace

double reference_of(const std::vector<MeasuredShift>& data) {
  const auto nearest = min_element(data, [](const MeasuredShift& a, const MeasuredShift& b) {
    return std::abs(std::log(a.factor)) < std::abs(std::log(b.factor));
  });
  return nearest->temperature;
}

std::optional<double> take_reference(std::vector<MeasuredShift>& data) {
  const auto is_reference = [](const MeasuredShift& row) { return row.factor == 1; };
  if (count_if(data, is_reference) != 1) return std::nullopt;
  const auto row = find_if(data, is_reference);
  const double temperature = row->temperature;
  data.erase(row);
  return temperature;
}

ShiftFit fit_shift(const std::vector<MeasuredShift>& data, const TemperatureShift& law, double deviation,
                   const FitOptions& options, std::optional<double> relative_to) {
  constexpr double off = 1.1;  // a fit that ends where it starts is no fit
  const double one = relative_to.value_or(law.reference);
  const TemperatureShift start = linear_shift(data, law, one);
  FitProblem problem;
  problem.parameters = shift_parameters(start);
  if (data.size() <= problem.parameters.size())
    throw std::invalid_argument("the shift factors are too few for the law");
  problem.parameters.front().start *= off;
  problem.deviations_known = std::isfinite(deviation);
  for (const MeasuredShift& row : data)
    problem.data.push_back({std::log(row.factor), problem.deviations_known ? deviation : 1, row.place});
  const auto values = [data, law, one](const FitPoint& point) {
    Eigen::VectorXd logarithms(std::ssize(data));
    const TemperatureShift here = shift_at(law, point);
    const double factor = shift_factor(here, one);
    for (std::size_t i = 0; i < data.size(); ++i)
      logarithms[static_cast<Eigen::Index>(i)] = std::log(shift_factor(here, data[i].temperature) / factor);
    return logarithms;
  };
  answer_by(problem, values, 1);
  ShiftFit answer{fit(problem, options), law};
  answer.shift = shift_at(law, answer.report.point());
  if (!answer.report.values.empty()) {
    answer.report.relative_rms = answer.report.rms;  // of ln a: over a itself
    judge(answer.report, problem);
  }
  return answer;
}

}  // namespace rollres
