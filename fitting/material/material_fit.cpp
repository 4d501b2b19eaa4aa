#include "fitting/material/material_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <stdexcept>
#include <utility>

#include "core/algebra/dense_algebra.hpp"
#include "core/material/passivity.hpp"
#include "fitting/material/even_series.hpp"
#include "fitting/material/free_shifts.hpp"
#include "fitting/material/material_problem.hpp"
#include "fitting/material/series_fit.hpp"
#include "fitting/material/vertical_shifts.hpp"

namespace rollres {

namespace {

constexpr Quantity stiffening{"stiffening", "f", "1", "G'(∞)/G'(0) - 1", not_negative};
constexpr Quantity creep_time{"creep_time", "τ", "s", "creep time", positive};
constexpr Quantity order{
    "order", "α", "1", "order of the spring-pot", {.lowest = 0, .highest = 1, .lowest_excluded = true}};

FractionalZener zener_at(const FitPoint& point, bool fractional) {
  return {point[0], point[1], point[2], fractional ? point[3] : 1};
}

/// The solid of least squares among those of an order and of a time theta of the spring-pot at its spring,
/// G* = G0 + G0 f (i omega theta)^order/(1 + (i omega theta)^order), which are linear in G0 and G0 f; tau =
/// theta (1 + f)^(1/order). @return its squares, and the solid
std::pair<double, FractionalZener> best_at(const std::vector<MeasuredModulus>& data, const TemperatureShift& shift,
                                           double theta, double order) {
  Eigen::MatrixXd a(2 * std::ssize(data), 2);
  Eigen::VectorXd b(2 * std::ssize(data));
  const ShiftFactors factors(shift);
  Eigen::Index row = 0;
  for (const MeasuredModulus& measured : data) {
    const double omega = measured.angular_frequency * factors.time(measured.temperature);
    const double scale = 1 / factors.modulus(measured.temperature);
    const std::complex<double> z = std::pow(std::complex<double>(0, omega * theta), order),
                               unit = scale * (1.0 - 1.0 / (1.0 + z));
    a.row(row) << scale / measured.storage_deviation, unit.real() / measured.storage_deviation;
    a.row(row + 1) << 0, unit.imag() / measured.loss_deviation;
    b[row] = measured.storage / measured.storage_deviation;
    b[row + 1] = measured.loss / measured.loss_deviation;
    row += 2;
  }
  const Eigen::VectorXd moduli = nonnegative_least_squares(a, b);
  const double softest =
      min_element(data, [](const auto& one, const auto& other) { return one.storage < other.storage; })->storage;
  constexpr double least = 0.01;  // a modulus at rest that the data do not show is thought to be somewhat below them
  const double at_rest = std::max(moduli[0], least * softest), f = std::max(moduli[1] / at_rest, 0.1);
  return {(a * moduli - b).squaredNorm(), {at_rest, f, theta * std::pow(1 + f, 1 / order), order}};
}

/// The best of the solids whose times lie where the data do, or a decade beyond.
FractionalZener nearest_zener(const std::vector<MeasuredModulus>& data, const TemperatureShift& shift,
                              std::span<const double> orders) {
  constexpr int times = 80;
  constexpr double beyond = 1;
  std::pair<double, FractionalZener> best{std::numeric_limits<double>::infinity(), {}};
  for (const double theta : even_times(data, shift, times, beyond))
    for (const double order : orders)
      if (const auto found = best_at(data, shift, theta, order); found.first < best.first) best = found;
  return best.second;
}

MaterialFit fit_zener(const std::vector<MeasuredModulus>& data, const MaterialFitOptions& options) {
  const bool fractional = options.form == MaterialForm::fractional_zener;
  constexpr std::array orders{1.0, 0.8, 0.6, 0.4, 0.2};
  constexpr double off = 1.1;  // a fit that ends where it starts is no fit
  MaterialFitOptions wanted = options;
  wanted.shift = best_shift(data, options);
  const FractionalZener start = nearest_zener(data, wanted.shift, std::span(orders).first(fractional ? 5 : 1));
  std::vector<FitParameter> parameters{parameter(modulus_at_rest, start.static_modulus),
                                       parameter(stiffening, start.stiffening),
                                       parameter(creep_time, off * start.creep_time)};
  if (fractional) parameters.push_back(parameter(order, std::min(start.order, 0.9)));
  MaterialFit answer = fitted_material(data, parameters, wanted, [fractional](const FitPoint& point, double omega) {
    return complex_modulus(zener_at(point, fractional), omega);
  });
  answer.zener = zener_at(answer.report.point(), fractional);
  return answer;
}

/// Values and predictions times the b_T that were found, as data are where a table gives it.
void scale_values(MaterialFit& answer, const std::vector<MeasuredModulus>& data) {
  const ShiftFactors factors(answer.shift);
  for (std::size_t i = 0; i < answer.report.values.size(); ++i) {
    FittedValue& value = answer.report.values[i];
    const double factor = factors.modulus(data[i / 2].temperature);
    for (double* const number : {&value.measured.value, &value.measured.deviation, &value.predicted, &value.band})
      *number *= factor;
  }
}

}  // namespace

TemperatureShift usual_constants(TemperatureShift shift, const std::vector<MeasuredModulus>& data) {
  const double coldest =
      min_element(data, [](const auto& a, const auto& b) { return a.temperature < b.temperature; })->temperature;
  constexpr double usual_c1 = 8.86, usual_c2 = 101.6, farther = 1.5;  // than the coldest lies the pole
  const double c2 = std::max(usual_c2, farther * (shift.reference - coldest));
  if (shift.law == ShiftLaw::wlf && !(shift.c1 > 0)) {
    shift.c1 = usual_c1;
    shift.c2 = c2;
  } else if (shift.law == ShiftLaw::vft && !(shift.vft_b > 0)) {
    shift.vft_temperature = std::max(0.5 * coldest, shift.reference - c2);
    shift.vft_b = usual_c1 * usual_c2 * std::numbers::ln10;
  }
  return shift;
}

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
  if (all_of(data, same)) throw std::invalid_argument("the moduli are all at one frequency: too few for a material");
  MaterialFitOptions wanted = options;
  if (options.free_shifts) {
    wanted.shift.law = ShiftLaw::table;
    wanted.shift.table.temperatures = steps_of_temperature(data);
    wanted.shift.table.factors.assign(wanted.shift.table.temperatures.size(), 1);
    wanted.shift = start_of_free_shifts(data, wanted);
  } else {
    wanted.shift = usual_constants(options.shift, data);
    wanted.shift.table.moduli.clear();  // the data are times b_T
  }
  const auto fit_with = [&](const MaterialFitOptions& given) {
    return given.form == MaterialForm::prony ? fit_series(data, given) : fit_zener(data, given);
  };
  MaterialFit answer = options.free_shifts ? with_vertical_shifts(data, wanted, fit_with) : fit_with(wanted);
  const MasterCurve curve = master_curve_of(data, answer.shift);
  const auto [lowest, highest] = minmax_element(curve.frequencies);
  if (*lowest < *highest) warn(answer.report, passivity_test(curve).in_words());
  warn(answer.report, swapped_moduli(curve.storage, curve.loss));
  if (!options.free_shifts) answer.shift.table.moduli = options.shift.table.moduli;
  if (options.free_shifts) {
    scale_values(answer, data);
    for (const LawThrough& law : laws_through(answer.shift)) answer.notes.push_back(law.in_words());
    warn(answer.report, without_overlap(data, answer.shift));
    const SuperpositionTest test =
        superposition_test(times_vertical_shifts(data, answer.shift), answer.shift.table.temperatures);
    if (test.holds())
      answer.notes.push_back(test.in_words());
    else
      warn(answer.report, test.in_words());
  }
  return answer;
}

}  // namespace rollres
