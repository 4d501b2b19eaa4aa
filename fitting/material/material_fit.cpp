#include "fitting/material/material_fit.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/material/passivity.hpp"
#include "fitting/material/material_problem.hpp"
#include "fitting/material/series_fit.hpp"

namespace rollres {

namespace {

constexpr Quantity stiffening{"stiffening", "f", "1", "G'(∞)/G'(0) - 1", not_negative};
constexpr Quantity creep_time{"creep_time", "τ", "s", "creep time", positive};
constexpr Quantity order{
    "order", "α", "1", "order of the spring-pot", {.lowest = 0, .highest = 1, .lowest_excluded = true}};

FractionalZener zener_at(const FitPoint& point, bool fractional) {
  return {point[0], point[1], point[2], fractional ? point[3] : 1};
}

MaterialFit fit_zener(const std::vector<MeasuredModulus>& data, const MaterialFitOptions& options) {
  const bool fractional = options.form == MaterialForm::fractional_zener;
  const auto by_storage = [](const auto& a, const auto& b) { return a.storage < b.storage; };
  const auto [soft, hard] = std::minmax_element(data.begin(), data.end(), by_storage);
  const auto lossy =
      std::max_element(data.begin(), data.end(), [](const auto& a, const auto& b) { return a.loss < b.loss; });
  const double ratio = std::max(hard->storage / soft->storage, 1.1);
  std::vector<FitParameter> parameters{parameter(modulus_at_rest, 0.8 * soft->storage), parameter(stiffening, ratio),
                                       parameter(creep_time, std::sqrt(ratio) / lossy->angular_frequency)};
  if (fractional) parameters.push_back(parameter(order, 0.6));
  MaterialFit answer = fitted_material(data, parameters, options, [fractional](const FitPoint& point, double omega) {
    return complex_modulus(zener_at(point, fractional), omega);
  });
  answer.zener = zener_at(answer.report.point(), fractional);
  return answer;
}

}  // namespace

std::complex<double> MaterialFit::modulus(double angular_frequency, double temperature) const {
  return modulus_at(report.point(), angular_frequency, temperature);
}

std::complex<double> MaterialFit::modulus_error(double angular_frequency, double temperature) const {
  const Eigen::Index size = std::ssize(report.parameters);
  const FitPoint point = report.point();
  Eigen::VectorXd storage(size), loss(size);
  constexpr double step = 1e-4;
  for (Eigen::Index j = 0; j < size; ++j) {
    const auto k = static_cast<std::size_t>(j);
    const Variable& variable = report.parameters[k].parameter.variable;
    FitPoint below = point, above = point;
    below[k] = variable.value(variable.scaled(point[k]) - step);
    above[k] = variable.value(variable.scaled(point[k]) + step);
    const std::complex<double> slope =
        (modulus_at(above, angular_frequency, temperature) - modulus_at(below, angular_frequency, temperature)) /
        variable.scaled_step(below[k], above[k]);
    storage[j] = slope.real();
    loss[j] = slope.imag();
  }
  const auto deviation = [&](const Eigen::VectorXd& slopes) {
    return std::sqrt(slopes.dot(report.errors.covariance * slopes));
  };
  return {deviation(storage), deviation(loss)};
}

MaterialFit fit_material(const std::vector<MeasuredModulus>& data, const MaterialFitOptions& options) {
  if (data.size() < 2) throw std::invalid_argument("the moduli are too few for a material");
  const auto same = [&](const MeasuredModulus& row) {
    return row.angular_frequency == data.front().angular_frequency && row.temperature == data.front().temperature;
  };
  if (std::all_of(data.begin(), data.end(), same))
    throw std::invalid_argument("the moduli are all at one frequency: too few for a material");
  MaterialFit answer = options.form == MaterialForm::prony ? fit_series(data, options) : fit_zener(data, options);
  const MasterCurve curve = master_curve_of(data, answer.shift);
  const auto [lowest, highest] = std::minmax_element(curve.frequencies.begin(), curve.frequencies.end());
  if (*lowest < *highest) warn(answer.report, passivity_test(curve).in_words());
  return answer;
}

}  // namespace rollres
