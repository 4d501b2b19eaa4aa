#include "fitting/material/moduli_fit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "core/messages/message_text.hpp"
#include "fitting/material/free_shifts.hpp"
#include "fitting/material/material_problem.hpp"
#include "fitting/material/series_slopes.hpp"

namespace rollres {

namespace {

constexpr Quantity series_modulus{"modulus", "G", "Pa", "modulus of one relaxation time", not_negative};
constexpr Quantity series_rest{"static_shear_modulus", "G0", "Pa", "G'(0)", not_negative};

/// The series of the first values of a point: its moduli and, unless they stay, its times.
PronySeries series_at(PronySeries series, const FitPoint& point, SeriesTimes times) {
  std::size_t next = 0;
  if (series.static_modulus > 0) series.static_modulus = point[next++];
  for (PronySeries::Term& term : series.terms) term.modulus = point[next++];
  if (times == SeriesTimes::free)
    for (PronySeries::Term& term : series.terms) term.time = point[next++];
  return series;
}

/// A modulus that may be 0, in parts of what the material has at its time.
FitParameter linear_parameter(const Quantity& quantity, double value, double size, std::string name) {
  constexpr double off = 1.1;  // a fit that ends where it starts is no fit
  return {std::move(name), {quantity, 0, quantity.range.highest, Scaling::linear, size}, off * value};
}

std::vector<FitParameter> series_parameters(const PronySeries& series) {
  std::vector<FitParameter> parameters;
  const double rest = series.static_modulus;
  if (rest > 0) parameters.push_back(linear_parameter(series_rest, rest, rest, std::string(series_rest.key)));
  for (const PronySeries::Term& term : series.terms)
    parameters.push_back(linear_parameter(series_modulus, term.modulus,
                                          std::abs(complex_modulus(series, 1 / term.time)),
                                          message_text("modulus (", term.time, " s)")));
  return parameters;
}

/// Slopes of a problem whose first parameters are the moduli of a series, and then its times unless they stay.
/// @param series  at the point
Slopes series_slopes(const std::vector<MeasuredModulus>& data, const PronySeries& series, SeriesTimes times,
                     const MaterialFitOptions& options, const FitProblem& problem, const FitPoint& point,
                     const Prediction& prediction) {
  constexpr double rounding = 1e-15;
  const Eigen::Index rows = prediction.values.size(), columns = std::ssize(problem.parameters);
  Eigen::MatrixXd slopes(rows, columns);
  const TemperatureShift here = shift_at(options.shift, point, options.free_shifts);
  const Eigen::MatrixXd units = modulus_slopes(data, here, series);  // what a unit modulus adds
  const Eigen::Index moduli = units.cols(), free = times == SeriesTimes::free ? std::ssize(series.terms) : 0,
                     constants = columns - moduli - free;
  for (Eigen::Index j = 0; j < moduli; ++j)
    slopes.col(j) = problem.parameters[static_cast<std::size_t>(j)].variable.size * units.col(j);
  if (free > 0) slopes.middleCols(moduli, free) = time_slopes(data, here, series);
  if (constants > 0)
    slopes.rightCols(constants) =
        shift_slopes(data, series, options, std::span(problem.parameters).last(static_cast<std::size_t>(constants)),
                     std::span(point).last(static_cast<std::size_t>(constants)));
  return exact_slopes(std::move(slopes), rounding * prediction.values.cwiseAbs());
}

/// The interval of a linear modulus: that of the slopes, cut off at 0.
void bound_modulus(FittedParameter& fitted, double threshold, bool profile) {
  ConfidenceInterval& interval = fitted.linear;
  if (!std::isfinite(interval.lowest)) return;
  const bool cut = interval.lowest <= 0;
  if (cut) {
    interval.lowest = 0;
    interval.low = IntervalEnd::limit;
  }
  if (!profile) return;
  const double part = fitted.value / (interval.highest - fitted.value);
  fitted.profile.interval = interval;
  fitted.profile.points = {
      {interval.lowest, cut ? threshold * part * part : threshold}, {fitted.value, 0}, {interval.highest, threshold}};
}

/// Intervals of a series' parameters: of the moduli and of free shifts by the slopes, of the constants of a law by
/// profiles.
void add_intervals(FitReport& report, const FitProblem& problem, std::size_t moduli, const MaterialFitOptions& wanted) {
  if (!report.slopes.found()) return;
  const FitOptions& options = wanted.options;
  const bool profiles = options.profiles && !wanted.free_shifts;
  const double threshold = interval_threshold(problem);
  for (std::size_t j = 0; j < moduli; ++j) bound_modulus(report.parameters[j], threshold, options.profiles);
  const Prediction prediction = problem.predict(report.point());
  const Descent end{report.point(), report.point(), report.chi_squared, prediction, true, report.stopped};
  for (std::size_t j = moduli; j < problem.size() && profiles && prediction.found(); ++j)
    report.parameters[j].profile = profile(problem, end, report.slopes, report.errors, j, threshold, options.stop);
  judge(report, problem);
  report.evaluations = problem.log->evaluations();
}

/// Leaves the measured values alone in a report: these are what is told and drawn.
void leave_out_priors(FitReport& report) {
  std::erase_if(report.values, [](const FittedValue& value) { return value.measured.prior(); });
  const auto size = [](const FittedValue& a, const FittedValue& b) {
    return std::abs(a.residual) < std::abs(b.residual);
  };
  report.largest_residual = static_cast<std::size_t>(max_element(report.values, size) - report.values.begin());
  if (!report.slopes.found()) return;
  const Eigen::Index rows = std::ssize(report.values);
  for (Eigen::MatrixXd* const matrix : {&report.slopes.derivatives, &report.slopes.errors})
    matrix->conservativeResize(rows, Eigen::NoChange);
  report.slopes.noise.conservativeResize(rows);
}

/// That times are where they are to within 0.3 of the way to the next.
/// @param parameter  the first of the times   @param deviation  of the rows, in theirs
std::vector<KnownBefore> near_times(const PronySeries& series, std::size_t parameter, double deviation) {
  constexpr double of_step = 0.3, least_step = 0.1;
  const std::size_t count = series.terms.size();
  std::vector<KnownBefore> known;
  for (std::size_t j = 0; j < count; ++j) {
    const std::size_t from = j > 0 ? j - 1 : 0, to = std::min(j + 1, count - 1);
    const double step = to > from
                            ? std::log(series.terms[to].time / series.terms[from].time) / static_cast<double>(to - from)
                            : std::numbers::ln10;
    KnownBefore& one = known.emplace_back();
    one.parts.push_back({parameter + j, true});
    one.mean = std::log(series.terms[j].time);
    one.deviation = of_step * std::max(std::abs(step), least_step) / deviation;
    one.of = "relaxation times";
  }
  return known;
}

}  // namespace

MaterialFit fit_moduli(const std::vector<MeasuredModulus>& data, const PronySeries& series,
                       const MaterialFitOptions& options, const KnownOfSeries& known) {
  std::vector<FitParameter> parameters = series_parameters(series);
  const std::size_t moduli = parameters.size();
  const SeriesTimes times = known.times;
  if (times == SeriesTimes::free)
    for (const PronySeries::Term& term : series.terms)
      parameters.push_back(parameter(relaxation_time, term.time, message_text("time (", term.time, " s)")));
  const auto modulus = [series, times](const FitPoint& point, double omega) {
    return complex_modulus(series_at(series, point, times), omega);
  };
  FitProblem problem = material_problem(data, parameters, options, modulus);
  const FitProblem plain = problem;
  problem.model.differentiate = [data, series, times, plain, options](const FitPoint& point,
                                                                      const Prediction& prediction) {
    return series_slopes(data, series_at(series, point, times), times, options, plain, point, prediction);
  };
  constexpr double looser = 2;  // than in the search for the shift
  if (options.free_shifts && known.deviation > 0)
    problem = with_priors(problem, even_steps(options.shift, known.deviation / looser, parameters.size()));
  if (times == SeriesTimes::free && known.deviation > 0)
    problem = with_priors(problem, near_times(series, moduli, known.deviation));
  FitOptions wanted = options.options;
  wanted.profiles = false;
  const FitPoint start = start_point(problem);
  if (const Prediction there = problem.predict(start); there.found())
    wanted.known = KnownSlopes{start, there, problem.differentiate(start, there)};
  MaterialFit answer = material_answer(fit(problem, wanted), options, modulus);
  add_intervals(answer.report, problem, moduli, options);
  leave_out_priors(answer.report);
  answer.prony = ordered(series_at(series, answer.report.point(), times));
  return answer;
}

}  // namespace rollres
