#include "fitting/fit/material_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/messages/message_text.hpp"
#include "core/numerics/dense_algebra.hpp"

namespace rollres {

namespace {

constexpr Quantity static_modulus{"static_shear_modulus", "G0", "Pa", "G'(0)", positive};
constexpr Quantity stiffening{"stiffening", "f", "1", "G'(∞)/G'(0) - 1", not_negative};
constexpr Quantity creep_time{"creep_time", "τ", "s", "creep time", positive};
constexpr Quantity order{
    "order", "α", "1", "order of the spring-pot", {.lowest = 0, .highest = 1, .lowest_excluded = true}};
constexpr Quantity relaxation_modulus{"modulus", "G", "Pa", "modulus of one relaxation time", positive};
constexpr Quantity wlf_c1{"wlf_c1", "c1", "1", "first constant of WLF", positive};
constexpr Quantity wlf_c2{"wlf_c2", "c2", "K", "second constant of WLF", positive};
constexpr Quantity energy{"activation_energy", "E", "J/mol", "of Arrhenius' law", not_negative};

FitParameter parameter(const Quantity& quantity, double start, std::string name = {}) {
  const double lowest =
      quantity.range.lowest_excluded ? std::nextafter(quantity.range.lowest, 1.0) : quantity.range.lowest;
  const bool logarithmic = quantity.range.lowest == 0 && quantity.range.highest > 1;
  return {name.empty() ? std::string(quantity.key) : std::move(name),
          {quantity, lowest, quantity.range.highest, logarithmic, logarithmic ? 1 : start},
          start};
}

std::vector<FitParameter> shift_parameters(const TemperatureShift& shift) {
  if (shift.law == ShiftLaw::wlf)
    return {parameter(wlf_c1, shift.c1 > 0 ? shift.c1 : 8.86), parameter(wlf_c2, shift.c2 > 0 ? shift.c2 : 101.6)};
  if (shift.law == ShiftLaw::arrhenius)
    return {parameter(energy, shift.activation_energy > 0 ? shift.activation_energy : 1e5)};
  return {};
}

/// The shift whose constants are the last values of a point.
TemperatureShift shift_at(TemperatureShift shift, const FitPoint& point) {
  const std::size_t n = point.size();
  if (shift.law == ShiftLaw::wlf) shift.c1 = point[n - 2], shift.c2 = point[n - 1];
  if (shift.law == ShiftLaw::arrhenius) shift.activation_energy = point[n - 1];
  return shift;
}

using ModulusAt = std::function<std::complex<double>(const FitPoint&, double reduced_frequency)>;

/// The problem of a material of the first parameters and a shift of the last.
FitProblem problem_of(const std::vector<MeasuredModulus>& data, std::vector<FitParameter> parameters,
                      const MaterialFitOptions& options, const ModulusAt& modulus) {
  FitProblem problem;
  problem.parameters = std::move(parameters);
  for (FitParameter& added : shift_parameters(options.shift)) problem.parameters.push_back(std::move(added));
  problem.deviations_known = options.deviations_known;
  for (const MeasuredModulus& row : data) {
    problem.data.push_back({row.storage, row.storage_deviation, row.place});
    problem.data.push_back({row.loss, row.loss_deviation, row.place});
  }
  const auto log = problem.log;
  problem.predict = [data, modulus, shift = options.shift, log](const FitPoint& point) {
    Prediction prediction{Eigen::VectorXd(2 * std::ssize(data))};
    try {
      const TemperatureShift here = shift_at(shift, point);
      Eigen::Index row = 0;
      for (const MeasuredModulus& measured : data) {
        const auto value = modulus(point, measured.angular_frequency * shift_factor(here, measured.temperature));
        prediction.values[row++] = value.real();
        prediction.values[row++] = value.imag();
      }
      log->answered();
    } catch (const std::invalid_argument& error) {
      prediction.reason = error.what();
      log->failed("", error.what());
    }
    return prediction;
  };
  const FitProblem plain = problem;
  problem.differentiate = [plain](const FitPoint& point, const Prediction& prediction) {
    constexpr double step = 1e-3, rounding = 1e-15;
    return differences(plain, point, prediction, step, rounding * prediction.values.cwiseAbs());
  };
  return problem;
}

/// The fit of a material of the first parameters and a shift of the last.
MaterialFit fitted(const std::vector<MeasuredModulus>& data, const std::vector<FitParameter>& parameters,
                   const MaterialFitOptions& options, const FitOptions& wanted, const ModulusAt& modulus) {
  const FitProblem problem = problem_of(data, parameters, options, modulus);
  MaterialFit answer{.report = fit(problem, wanted), .zener = {}, .prony = {}, .shift = {}};
  answer.shift = shift_at(options.shift, answer.report.point());
  answer.modulus_at = [modulus, shift = options.shift](const FitPoint& point, double omega, double temperature) {
    return modulus(point, omega * shift_factor(shift_at(shift, point), temperature));
  };
  return answer;
}

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
  std::vector<FitParameter> parameters{parameter(static_modulus, 0.8 * soft->storage), parameter(stiffening, ratio),
                                       parameter(creep_time, std::sqrt(ratio) / lossy->angular_frequency)};
  if (fractional) parameters.push_back(parameter(order, 0.6));
  MaterialFit answer =
      fitted(data, parameters, options, options.options, [fractional](const FitPoint& point, double omega) {
        return complex_modulus(zener_at(point, fractional), omega);
      });
  answer.zener = zener_at(answer.report.point(), fractional);
  return answer;
}

/// Relaxation times in even steps of their logarithm over the reduced frequencies.
std::vector<double> relaxation_times(const std::vector<MeasuredModulus>& data, const TemperatureShift& shift,
                                     int terms) {
  double lowest = std::numeric_limits<double>::infinity(), highest = 0;
  for (const MeasuredModulus& row : data) {
    const double omega = row.angular_frequency * shift_factor(shift, row.temperature);
    lowest = std::min(lowest, omega);
    highest = std::max(highest, omega);
  }
  std::vector<double> times;
  for (int j = 0; j < terms; ++j) times.push_back(std::pow(lowest / highest, (j + 0.5) / terms) / lowest);
  std::sort(times.begin(), times.end());
  return times;
}

/// The series of these times by non-negative least squares, and its sum of squares.
struct LinearSeries {
  PronySeries series;
  double squares;
};
LinearSeries linear_series(const std::vector<MeasuredModulus>& data, const TemperatureShift& shift, int terms) {
  const std::vector<double> times = relaxation_times(data, shift, terms);
  Eigen::MatrixXd a(2 * std::ssize(data), terms + 1);
  Eigen::VectorXd b(2 * std::ssize(data));
  Eigen::Index row = 0;
  for (const MeasuredModulus& measured : data) {
    const double omega = measured.angular_frequency * shift_factor(shift, measured.temperature);
    const auto fill = [&](double value, double deviation, auto part) {
      b[row] = value / deviation;
      a(row, 0) = part(complex_modulus(PronySeries{1, {}}, omega)) / deviation;
      for (Eigen::Index j = 0; j < terms; ++j)
        a(row, j + 1) =
            part(complex_modulus(PronySeries{0, {{1, times[static_cast<std::size_t>(j)]}}}, omega)) / deviation;
      ++row;
    };
    fill(measured.storage, measured.storage_deviation, [](std::complex<double> g) { return g.real(); });
    fill(measured.loss, measured.loss_deviation, [](std::complex<double> g) { return g.imag(); });
  }
  const Eigen::VectorXd moduli = nonnegative_least_squares(a, b);
  LinearSeries answer{{moduli[0], {}}, (a * moduli - b).squaredNorm()};
  for (Eigen::Index j = 0; j < terms; ++j)
    if (moduli[j + 1] > 0) answer.series.terms.push_back({moduli[j + 1], times[static_cast<std::size_t>(j)]});
  return answer;
}

/// The series with the least corrected information criterion (Hurvich and Tsai 1989, Biometrika 76, 297).
LinearSeries automatic_series(const std::vector<MeasuredModulus>& data, const TemperatureShift& shift) {
  constexpr int most = 20;
  std::optional<LinearSeries> best;
  double least = std::numeric_limits<double>::infinity();
  const double count = 2.0 * static_cast<double>(data.size());
  for (int terms = 1; terms <= most; ++terms) {
    LinearSeries series = linear_series(data, shift, terms);
    const double unknowns = static_cast<double>(series.series.terms.size()) + 2;
    if (unknowns + 2 > count) break;
    const double criterion = count * std::log(series.squares / count) + 2 * unknowns +
                             2 * unknowns * (unknowns + 1) / (count - unknowns - 1);
    if (criterion >= least) continue;
    least = criterion;
    best = std::move(series);
  }
  if (!best) throw std::invalid_argument("the moduli are too few for a Prony series");
  return *best;
}

PronySeries series_at(PronySeries series, const FitPoint& point) {
  std::size_t next = 0;
  if (series.static_modulus > 0) series.static_modulus = point[next++];
  for (PronySeries::Term& term : series.terms) term.modulus = point[next++];
  return series;
}

/// The fit of the moduli of these terms.
MaterialFit fit_series(const std::vector<MeasuredModulus>& data, const PronySeries& series,
                       const MaterialFitOptions& options, bool profiles) {
  constexpr double off = 1.1;
  std::vector<FitParameter> parameters;
  if (series.static_modulus > 0) parameters.push_back(parameter(static_modulus, off * series.static_modulus));
  for (const PronySeries::Term& term : series.terms)
    parameters.push_back(
        parameter(relaxation_modulus, off * term.modulus, message_text("modulus (", term.time, " s)")));
  FitOptions wanted = options.options;
  wanted.profiles &= profiles;
  MaterialFit answer = fitted(data, parameters, options, wanted, [series](const FitPoint& point, double omega) {
    return complex_modulus(series_at(series, point), omega);
  });
  answer.prony = series_at(series, answer.report.point());
  return answer;
}

/// The term that the data bind least, if they do not tell it from 0: where it is G0, the slowest. A last one stays.
std::optional<std::size_t> loose_term(const FitReport& report, const PronySeries& series) {
  const std::size_t first = series.static_modulus > 0 ? 1 : 0;
  if (series.terms.size() < 2 || !report.slopes.found()) return std::nullopt;
  std::optional<std::size_t> loose;
  double largest = 0.5;
  for (std::size_t j = 0; j < first + series.terms.size(); ++j) {
    const FittedParameter& fitted = report.parameters[j];
    const bool open = !fitted.profile.points.empty() && fitted.profile.interval.low == IntervalEnd::open;
    const double doubt = std::isfinite(fitted.relative_error) ? fitted.relative_error + (open ? 1 : 0) : 1e300;
    if (!(doubt > largest)) continue;
    largest = doubt;
    loose = j < first ? series.terms.size() - 1 : j - first;
  }
  return loose;
}

MaterialFit fit_prony(const std::vector<MeasuredModulus>& data, const MaterialFitOptions& options) {
  MaterialFitOptions wanted = options;
  const std::vector<FitParameter> shift = shift_parameters(options.shift);
  FitPoint constants;
  for (const FitParameter& constant : shift) constants.push_back(constant.start);
  wanted.shift = shift_at(options.shift, constants);
  const bool automatic = options.terms == 0;
  // Which moduli are 0 depends on the shift: once more with the shift that was found.
  const int rounds = shift.empty() ? 1 : 2;
  for (int round = 1;; ++round) {
    const bool last = round == rounds;
    PronySeries series =
        (automatic ? automatic_series(data, wanted.shift) : linear_series(data, wanted.shift, options.terms)).series;
    MaterialFit answer = fit_series(data, series, wanted, last && !automatic);
    while (automatic) {
      std::optional<std::size_t> loose = loose_term(answer.report, series);
      if (!loose && last && options.options.profiles) {
        answer = fit_series(data, series, wanted, true);
        loose = loose_term(answer.report, series);
      }
      if (!loose) break;
      series.terms.erase(series.terms.begin() + static_cast<std::ptrdiff_t>(*loose));
      answer = fit_series(data, series, wanted, false);
    }
    if (last) return answer;
    wanted.shift = answer.shift;
  }
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
  return options.form == MaterialForm::prony ? fit_prony(data, options) : fit_zener(data, options);
}

}  // namespace rollres
