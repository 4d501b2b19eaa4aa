#include "fitting/material/series_fit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>

#include "core/material/master_curve.hpp"
#include "core/messages/message_text.hpp"
#include "fitting/material/even_series.hpp"
#include "fitting/material/free_shifts.hpp"
#include "fitting/material/material_problem.hpp"
#include "fitting/material/moduli_fit.hpp"
#include "fitting/material/series_slopes.hpp"

namespace rollres {

namespace {

constexpr Quantity relaxation_modulus{"modulus", "G", "Pa", "modulus of one relaxation time", positive};

/// What rows deviate from a series by, in their deviations.
double deviation_from(const EvenSeries& series, const std::vector<MeasuredModulus>& data,
                      const MaterialFitOptions& options) {
  const double freedom = std::max(1.0, 2 * static_cast<double>(data.size()) - series.moduli());
  return options.deviations_known ? 1 : std::sqrt(series.squares / freedom);
}

/// That a smooth spectrum has another loss between the rows: what rows far apart leave open.
std::string open_between_rows(const std::vector<MeasuredModulus>& data, const MaterialFit& found) {
  constexpr double noticeable = 0.1;
  constexpr int pieces = 200;
  const MasterCurve curve = master_curve_of(data, found.shift);
  const auto [lowest, highest] = minmax_element(curve.frequencies);
  if (!(*lowest < *highest)) return "";
  const PronySeries smooth = fit_master_curve(curve).series;
  double largest = 0, where = 0;
  for (int i = 0; i <= pieces; ++i) {
    const double frequency = *lowest * std::pow(*highest / *lowest, 1.0 * i / pieces);
    const double omega = 2 * std::numbers::pi * frequency;
    const double one = complex_modulus(found.prony, omega).imag(), other = complex_modulus(smooth, omega).imag();
    if (const double apart = std::abs(one - other) / std::max(one, other); apart > largest)
      largest = apart, where = frequency;
  }
  if (largest < noticeable) return "";
  return message_text<3>("the rows leave the loss modulus between them open: that of a smooth spectrum, as a scene's ",
                         "master_curve has it, differs by up to ", 100 * largest, " % (at ", where, " Hz)");
}

/// The times of a series without the one that the data tell least from its neighbours; empty if they tell all.
std::vector<double> told_times(const FitReport& report, const PronySeries& series) {
  const Eigen::VectorXd& weakest = report.errors.weakest;
  const Eigen::Index terms = std::ssize(series.terms), first = series.static_modulus > 0 ? 1 : 0;
  if (terms < 2 || weakest.size() < first + terms || report.errors.weakest_deviation < 1) return {};
  Eigen::Index least = 0;
  weakest.segment(first, terms).cwiseAbs().maxCoeff(&least);
  std::vector<double> times;
  for (Eigen::Index j = 0; j < terms; ++j)
    if (j != least) times.push_back(series.terms[static_cast<std::size_t>(j)].time);
  return times;
}

/// The fit again from times that it has moved, as long as that joins rows better.
MaterialFit with_settled_times(const std::vector<MeasuredModulus>& data, MaterialFit found, MaterialFitOptions options,
                               KnownOfSeries known) {
  constexpr int most_rounds = 4;
  constexpr double noticeable = 0.05;
  for (int round = 0; round < most_rounds && found.report.slopes.found(); ++round) {
    if (!options.deviations_known) known.deviation = std::sqrt(found.report.errors.scale);
    options.shift = found.shift;
    PronySeries told = found.prony;
    std::erase_if(told.terms, [](const PronySeries::Term& term) { return !(term.modulus > 0); });
    MaterialFit next = fit_moduli(data, told, options, known);
    if (!(next.report.chi_squared < (1 - noticeable) * found.report.chi_squared)) break;
    next.notes = found.notes;
    found = std::move(next);
  }
  return found;
}

MaterialFit fit_even(const std::vector<MeasuredModulus>& data, const MaterialFitOptions& options) {
  constexpr std::size_t most_moving = 30;  // beyond, descents do not settle
  MaterialFitOptions wanted = options;
  wanted.shift = best_shift(data, options);
  const bool automatic = options.terms == 0;
  EvenSeries series = automatic ? automatic_series(data, wanted.shift, options.deviations_known)
                                : even_series(data, wanted.shift, options.terms);
  KnownOfSeries known{deviation_from(series, data, options)};
  if (automatic && options.free_shifts && known.deviation > 0) {
    EvenSeries denser = even_series(data, wanted.shift, series.times + series.times / 2, series.beyond);
    if (denser.series.terms.size() <= most_moving) {
      known.times = SeriesTimes::free;
      series = std::move(denser);
    }
  }
  if (series.series.terms.empty()) throw std::invalid_argument("the moduli are those of an elastic material");
  PronySeries told = series.series;
  MaterialFit answer = fit_moduli(data, told, wanted, known);
  for (std::vector<double> times = told_times(answer.report, told); automatic && !times.empty();
       times = told_times(answer.report, told)) {
    told = series_at_times(data, wanted.shift, times).series;
    answer = fit_moduli(data, told, wanted, known);
  }
  const bool moving = known.times == SeriesTimes::free;
  if (moving) answer = with_settled_times(data, std::move(answer), wanted, known);
  answer.notes.push_back(message_text(series.times, " relaxation times in even steps of their logarithm",
                                      moving ? ", half as many again as the data ask for, each free within its step"
                                      : automatic ? ", as many as the data ask for"
                                                  : "",
                                      "; ", told.terms.size(), " of them have a modulus that is not 0"));
  warn(answer.report, open_between_rows(data, answer));
  return answer;
}

/// Terms of free times to start from: those of a dense series, two neighbours as one as long as there are too many,
/// each time the two whose loss costs least.
PronySeries joined_series(const std::vector<MeasuredModulus>& data, const TemperatureShift& shift, int terms) {
  constexpr int dense = 60;
  EvenSeries series = even_series(data, shift, dense);
  while (std::ssize(series.series.terms) > terms) {
    const std::vector<PronySeries::Term>& all = series.series.terms;
    std::optional<EvenSeries> best;
    for (std::size_t j = 0; j + 1 < all.size(); ++j) {
      std::vector<double> times;
      for (std::size_t k = 0; k < all.size(); ++k)
        if (k != j + 1) times.push_back(all[k].time);
      const double sum = all[j].modulus + all[j + 1].modulus;
      times[j] =
          std::exp((all[j].modulus * std::log(all[j].time) + all[j + 1].modulus * std::log(all[j + 1].time)) / sum);
      EvenSeries fewer = series_at_times(data, shift, times);
      if (!best || fewer.squares < best->squares) best = std::move(fewer);
    }
    series = std::move(*best);
  }
  PronySeries start = series.series;
  if (std::ssize(start.terms) == terms) return start;
  constexpr double small = 0.01;  // of what stands there, for a modulus that was 0
  start.terms.clear();
  for (const double time : even_times(data, shift, terms)) {
    const double there = std::abs(complex_modulus(series.series, 1 / time));
    start.terms.push_back({small * there, time});
  }
  return start;
}

MaterialFit fit_free(const std::vector<MeasuredModulus>& data, const MaterialFitOptions& options) {
  MaterialFitOptions wanted = options;
  wanted.shift = best_shift(data, options);
  const PronySeries start = joined_series(data, wanted.shift, options.terms);
  const bool rests = start.static_modulus > 0;
  std::vector<FitParameter> parameters;
  if (rests) parameters.push_back(parameter(modulus_at_rest, start.static_modulus));
  for (std::size_t j = 0; j < start.terms.size(); ++j) {
    const std::string number = message_text(" ", j + 1);
    parameters.push_back(parameter(relaxation_modulus, start.terms[j].modulus, "modulus" + number));
    parameters.push_back(parameter(relaxation_time, start.terms[j].time, "time" + number));
  }
  const auto series = [rests, terms = start.terms.size()](const FitPoint& point) {
    PronySeries at;
    std::size_t next = 0;
    if (rests) at.static_modulus = point[next++];
    for (std::size_t j = 0; j < terms; ++j, next += 2) at.terms.push_back({point[next], point[next + 1]});
    return at;
  };
  MaterialFit answer = fitted_material(data, parameters, wanted, [series](const FitPoint& point, double omega) {
    return complex_modulus(series(point), omega);
  });
  answer.prony = ordered(series(answer.report.point()));
  return answer;
}

}  // namespace

TemperatureShift best_shift(const std::vector<MeasuredModulus>& data, const MaterialFitOptions& options) {
  FitProblem problem =
      material_problem(data, {}, options, [](const FitPoint&, double) { return std::complex<double>(); });
  FitPoint end = start_point(problem);
  if (end.empty()) return options.shift;
  const auto shift_of = [&](const FitPoint& point) { return shift_at(options.shift, point, options.free_shifts); };
  EvenSeries basis;
  problem.model.predict = [&](const FitPoint& point, const DataRows&) {
    Prediction prediction{Eigen::VectorXd(2 * std::ssize(data))};
    try {
      const TemperatureShift here = shift_of(point);
      const PronySeries series = even_series(data, here, basis.times, basis.beyond).series;
      const ShiftFactors factors(here);
      Eigen::Index row = 0;
      for (const MeasuredModulus& measured : data) {
        const auto value = complex_modulus(series, measured.angular_frequency * factors.time(measured.temperature)) /
                           factors.modulus(measured.temperature);
        prediction.values[row++] = value.real();
        prediction.values[row++] = value.imag();
      }
    } catch (const std::invalid_argument& error) {
      prediction.reason = error.what();
    }
    return prediction;
  };
  problem.model.differentiate = [&](const FitPoint& point, const Prediction& prediction) {
    if (!options.free_shifts) {  // few constants: a step beyond the kinks where a modulus becomes 0
      constexpr double step = 1e-2, rounding = 1e-12;
      return differences(problem, point, prediction, step, rounding * prediction.values.cwiseAbs());
    }
    const PronySeries series = even_series(data, shift_of(point), basis.times, basis.beyond).series;
    return exact_slopes(following_slopes(data, series, prediction.values, options, problem.parameters, point),
                        Eigen::VectorXd::Zero(prediction.values.size()));
  };
  constexpr int most_rounds = 4;  // as rows join better, they ask for other times
  for (int round = 0, times = 0; round < most_rounds; ++round) {
    basis = automatic_series(data, shift_of(end), options.deviations_known);
    if (basis.times == times) break;
    times = basis.times;
    const double deviation = deviation_from(basis, data, options);
    const FitProblem preferring =
        options.free_shifts && deviation > 0 ? with_priors(problem, even_steps(shift_of(end), deviation)) : problem;
    const Descent found = descend(preferring, end, {.tolerance = 1e-4, .stop = options.options.stop});
    if (!found.found()) break;
    end = found.end;
  }
  return shift_of(end);
}

MaterialFit fit_series(const std::vector<MeasuredModulus>& data, const MaterialFitOptions& options) {
  const bool free = options.times ? *options.times == SeriesTimes::free
                                  : options.terms > 0 && options.terms <= usual_free_terms &&
                                        2 * data.size() > 2 * static_cast<std::size_t>(options.terms) + 3;
  if (free && (options.terms == 0 || options.terms > most_free_terms))
    throw std::invalid_argument(message_text("free times: need a number of terms from 1 to ", most_free_terms));
  return free ? fit_free(data, options) : fit_even(data, options);
}

}  // namespace rollres
