#include "fitting/material/shift_fit.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/numerics/dense_algebra.hpp"
#include "fitting/material/material_problem.hpp"

namespace rollres {

namespace {

/// The constants of least squares where the law is linear: c1 (T - T0) + c2 log10 a = -(T - T0) log10 a for WLF,
/// ln a = E/R (1/T - 1/T0) for Arrhenius. Those that make no sense are left at 0.
TemperatureShift linear_shift(const std::vector<MeasuredShift>& data, TemperatureShift law) {
  const Eigen::Index rows = std::ssize(data);
  Eigen::MatrixXd a(rows, 2);
  Eigen::VectorXd b(rows), log_factor(rows), inverse(rows);
  double lowest = 0;
  for (Eigen::Index i = 0; i < rows; ++i) {
    const MeasuredShift& row = data[static_cast<std::size_t>(i)];
    const double above = row.temperature - law.reference, decades = std::log10(row.factor);
    a.row(i) << above, decades;
    b[i] = -above * decades;
    log_factor[i] = std::log(row.factor);
    inverse[i] = 1 / row.temperature - 1 / law.reference;
    lowest = std::min(lowest, above);
  }
  constexpr double gas_constant = 8.31446261815324;  // [J/(mol K)]
  if (law.law == ShiftLaw::arrhenius) {
    law.activation_energy = std::max(0.0, gas_constant * inverse.dot(log_factor) / inverse.squaredNorm());
    return law;
  }
  const Eigen::VectorXd constants = least_squares(a, b);
  constexpr double farther = 1.05;  // than the lowest temperature lies the pole
  const bool sound = constants[0] > 0 && constants[1] > -farther * lowest;
  law.c1 = sound ? constants[0] : 8.86;
  law.c2 = sound ? constants[1] : std::max(101.6, -2 * lowest);
  return law;
}

}  // namespace

double reference_of(const std::vector<MeasuredShift>& data) {
  const auto nearest = std::min_element(data.begin(), data.end(), [](const MeasuredShift& a, const MeasuredShift& b) {
    return std::abs(std::log(a.factor)) < std::abs(std::log(b.factor));
  });
  return nearest->temperature;
}

ShiftFit fit_shift(const std::vector<MeasuredShift>& data, const TemperatureShift& law, double deviation,
                   const FitOptions& options) {
  constexpr double off = 1.1;  // a fit that ends where it starts is no fit
  const TemperatureShift start = linear_shift(data, law);
  FitProblem problem;
  problem.parameters = shift_parameters(start);
  if (data.size() <= problem.parameters.size())
    throw std::invalid_argument("the shift factors are too few for the law");
  problem.parameters.front().start *= off;
  problem.deviations_known = std::isfinite(deviation);
  for (const MeasuredShift& row : data)
    problem.data.push_back({std::log(row.factor), problem.deviations_known ? deviation : 1, row.place});
  const auto values = [data, law](const FitPoint& point) {
    Eigen::VectorXd logarithms(std::ssize(data));
    for (std::size_t i = 0; i < data.size(); ++i)
      logarithms[static_cast<Eigen::Index>(i)] = std::log(shift_factor(shift_at(law, point), data[i].temperature));
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
