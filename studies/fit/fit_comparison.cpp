#include "studies/fit/fit_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <sstream>
#include <stdexcept>

#include "fitting/errors/information_criteria.hpp"
#include "fitting/errors/statistics.hpp"
#include "fitting/fit/experiment_design.hpp"
#include "fitting/fit/measured_terms.hpp"
#include "studies/fit/design_space.hpp"
#include "studies/scene_io/scene_inputs.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/table_json.hpp"
#include "studies/text/table_output.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

bool has_fitted_noise(const FitCandidate& fit) { return !fit.report.noise_terms.empty(); }

void require_comparable(const FitCandidate& a, const FitCandidate& b) {
  if (b.report.values.empty()) throw std::invalid_argument(b.source + ": has no prediction to compare");
  if (b.resistance && b.resistance->loss != Loss::none)
    throw std::invalid_argument(b.source + ": loss = " + std::string(name_of(b.resistance->loss)) +
                                ": a robust loss has no likelihood, so fits with it cannot be compared");
  const bool noise = has_fitted_noise(a) || has_fitted_noise(b);
  const auto same = [&](const FittedValue& one, const FittedValue& other) {
    const auto equal = [](double x, double y) { return std::abs(x - y) <= 1e-12 * std::abs(x); };
    return equal(one.measured.value, other.measured.value) &&
           (noise || equal(one.measured.deviation, other.measured.deviation));
  };
  if (a.report.deviations_known != b.report.deviations_known ||
      !std::equal(a.report.values.begin(), a.report.values.end(), b.report.values.begin(), b.report.values.end(), same))
    throw std::invalid_argument(b.source + ": has other data, or other deviations of them, than " + a.source +
                                ": only fits of the same data can be compared");
}

/// @param any_noise  the noise is fitted in one of the fits that are compared
ComparedFit compared(const FitCandidate& fit, bool any_noise) {
  ComparedFit answer{fit.name, fit.model, std::string(name_of(fit.report.status))};
  answer.usable = fit.report.status >= FitStatus::usable_with_warnings;
  answer.parameters = static_cast<int>(fit.report.parameters.size() + fit.report.noise_terms.size());
  answer.chi_squared = fit.report.chi_squared;
  double log_variances = 0;
  for (const FittedValue& value : fit.report.values)
    if (any_noise) log_variances += 2 * std::log(value.measured.deviation);
  const InformationCriteria criteria =
      information_criteria(answer.chi_squared, fit.report.values.size(), answer.parameters,
                           fit.report.deviations_known || has_fitted_noise(fit), log_variances);
  answer.likelihood = criteria.likelihood;
  if (any_noise && !has_fitted_noise(fit)) {  // the likelihood at the best scale has n, as chi squared has elsewhere
    const auto n = static_cast<double>(fit.report.values.size());
    answer.likelihood += n;
    answer.aicc = criteria.aicc + n;
    answer.bic = criteria.bic + n;
    return answer;
  }
  answer.aicc = criteria.aicc;
  answer.bic = criteria.bic;
  return answer;
}

bool has_free_times(const FitCandidate& fit) {
  return fit.file->options.form == MaterialForm::prony &&
         fit.report.parameters.back().parameter.name.starts_with("time");
}

/// Whether one material is a case of another, with the same shift.
bool is_case_of(const FitCandidate& small, const FitCandidate& large) {
  const MaterialForm a = small.file->options.form, b = large.file->options.form;
  if (small.file->options.shift.law != ShiftLaw::none || large.file->options.shift.law != ShiftLaw::none) return false;
  if (a == MaterialForm::zener) return b == MaterialForm::fractional_zener || (b == a ? false : has_free_times(large));
  return a == MaterialForm::prony && a == b && has_free_times(small) && has_free_times(large);
}

/// Arrhenius' law is VFT's with its temperature at 0, and WLF's with c2 at the reference.
bool is_case_of(ShiftLaw small, ShiftLaw large) {
  return small == ShiftLaw::arrhenius && (large == ShiftLaw::wlf || large == ShiftLaw::vft);
}

/// Whether the scenes of one fit are those of another with its inputs at some values.
bool is_case_of(const FitFile& small, const FitFile& large) {
  const auto fits = [&](const FittedInput& input) {
    return any_of(large.inputs, [&](const FittedInput& other) {
      return other.input.key == input.input.key && (other.set.empty() || other.set == input.set);
    });
  };
  if (!all_of(small.inputs, fits)) return false;
  for (std::size_t row = 0; row < small.scenes.size(); ++row) {
    RollingScene scene = small.scenes[row].scene;
    for (const FittedInput& input : large.inputs)
      if (!is_measured_term(input.input.key))
        set_input(scene, input.input.key, real_input(large.scenes[row].scene, input.input.key));
    if (!(scene == large.scenes[row].scene)) return false;
  }
  return small.output == large.output;
}

std::vector<LikelihoodRatio> likelihood_ratios(const std::vector<FitCandidate>& fits, bool any_noise) {
  std::vector<LikelihoodRatio> ratios;
  for (const FitCandidate& small : fits)
    for (const FitCandidate& large : fits) {
      const ComparedFit a = compared(small, any_noise), b = compared(large, any_noise);
      const int degrees = b.parameters - a.parameters;
      const bool nested = small.file && large.file               ? is_case_of(small, large)
                          : small.resistance && large.resistance ? is_case_of(*small.resistance, *large.resistance)
                                                                 : is_case_of(small.shift_law, large.shift_law);
      if (degrees <= 0 || !nested) continue;
      const double rise = std::max(0.0, a.likelihood - b.likelihood);
      ratios.push_back({small.name, large.name, rise, degrees, chi_squared_tail(rise, degrees)});
    }
  return ratios;
}

/// Offers a place where two predictions differ.
void offer(std::optional<LargestDifference>& largest, const LargestDifference& one) {
  if (std::isfinite(one.deviations) && (!largest || one.deviations > largest->deviations)) largest = one;
}

/// Over the frequencies of the data and a decade beyond, at the temperatures of the data.
std::optional<LargestDifference> material_difference(const FitCandidate& a, const FitCandidate& b) {
  constexpr int pieces = 120;
  const std::vector<MeasuredModulus>& data = a.file->data;
  double lowest = std::numeric_limits<double>::infinity(), highest = 0;
  std::set<double> temperatures;
  for (const MeasuredModulus& row : data) {
    lowest = std::min(lowest, 0.1 * row.angular_frequency);
    highest = std::max(highest, 10 * row.angular_frequency);
    temperatures.insert(row.temperature);
  }
  const double scatter = std::sqrt(std::min(a.report.errors.scale, b.report.errors.scale));
  const double relative[2] = {scatter * data.front().storage_deviation / data.front().storage,
                              scatter * data.front().loss_deviation / data.front().loss};
  std::optional<LargestDifference> largest;
  for (const double temperature : temperatures)
    for (int i = 0; i <= pieces; ++i) {
      const double omega = lowest * std::pow(highest / lowest, 1.0 * i / pieces);
      const auto x = a.material->modulus(omega, temperature), y = b.material->modulus(omega, temperature);
      const auto dx = a.material->modulus_error(omega, temperature), dy = b.material->modulus_error(omega, temperature);
      std::string where = " at " + readable(omega / (2 * std::numbers::pi), "Hz");
      if (temperatures.size() > 1) where += " and " + readable(temperature, "K");
      const auto add = [&](const char* what, double one, double other, double error, double second, double noise) {
        const auto finite = [](double e) { return std::isfinite(e) ? e : 0; };
        const double deviation = std::hypot(noise * one, finite(error), finite(second));
        offer(largest, {a.name, b.name, what + where, "Pa", {one, other}, std::abs(one - other) / deviation});
      };
      add("storage_modulus", x.real(), y.real(), dx.real(), dy.real(), relative[0]);
      add("loss_modulus", x.imag(), y.imag(), dx.imag(), dy.imag(), relative[1]);
    }
  return largest;
}

/// At the measurements.
std::optional<LargestDifference> scene_difference(const FitCandidate& a, const FitCandidate& b) {
  std::optional<LargestDifference> largest;
  const double scatter = std::sqrt(std::min(a.report.errors.scale, b.report.errors.scale));
  const std::string_view unit = real_output(a.resistance->output).unit_for(a.resistance->body());
  for (std::size_t row = 0; row < a.report.values.size(); ++row) {
    const FittedValue &x = a.report.values[row], &y = b.report.values[row];
    const auto finite = [](double e) { return std::isfinite(e) ? e : 0; };
    const double deviation = std::hypot(scatter * x.measured.deviation, finite(x.band), finite(y.band));
    offer(largest, {a.name,
                    b.name,
                    a.resistance->output + " at " + x.measured.place,
                    unit,
                    {x.predicted, y.predicted},
                    std::abs(x.predicted - y.predicted) / deviation});
  }
  return largest;
}

bool slopes_known(const FitCandidate& fit) { return fit.report.slopes.found() && !fit.report.interrupted; }

/// What a fit says of scenes, and the standard errors of that.
std::vector<std::pair<double, double>> predicted(const FitCandidate& fit, const std::vector<MeasuredScene>& scenes,
                                                 const Evaluate& evaluate, int jobs) {
  const FitFile& file = *fit.resistance;
  const Eigen::MatrixXd covariance = design_covariance(fit.report);
  std::vector<std::pair<double, double>> all;
  for (const ScenePrediction& one : predictions_at(fit.report, file.inputs, scenes, evaluate,
                                                   {.output = file.output, .jobs = jobs, .step = file.step}))
    all.emplace_back(one.value, std::sqrt(std::max(0.0, one.slope.dot(covariance * one.slope))));
  return all;
}

/// Anywhere in the design space of the first fit: the measurement that tells both apart best.
std::optional<LargestDifference> next_difference(const FitCandidate& a, const FitCandidate& b, const Evaluate& evaluate,
                                                 int jobs) {
  DesignSpace space = design_space(*a.resistance);
  const DesignSpace other = design_space(*b.resistance);
  for (const FitFile* const file : {&*a.resistance, &*b.resistance})
    std::erase_if(space.ranges, [&](const DesignRange& range) {
      return any_of(file->inputs, [&](const FittedInput& input) { return input.input.key == range.key; });
    });
  if (space.empty() || !slopes_known(a) || !slopes_known(b)) return std::nullopt;
  const auto of_other = [&](const MeasuredScene& scene) {
    const auto set = find_if(other.sets, [&](const MeasuredScene& one) { return one.set == scene.set; });
    MeasuredScene same = set == other.sets.end() ? other.sets.front() : *set;
    for (const DesignRange& range : space.ranges) set_input(same.scene, range.key, real_input(scene.scene, range.key));
    return same;
  };
  const double relative = std::min(usual_relative_deviation(a.report), usual_relative_deviation(b.report));
  std::optional<LargestDifference> largest;
  search_space(space, [&](const std::vector<MeasuredScene>& scenes) {
    std::vector<MeasuredScene> others;
    for (const MeasuredScene& scene : scenes) others.push_back(of_other(scene));
    const auto x = predicted(a, scenes, evaluate, jobs), y = predicted(b, others, evaluate, jobs);
    std::vector<double> values;
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      const double deviation = std::hypot(relative * x[i].first, x[i].second, y[i].second);
      LargestDifference one{
          a.name, b.name, "", "", {x[i].first, y[i].first}, std::abs(x[i].first - y[i].first) / deviation};
      values.push_back(std::isfinite(one.deviations) ? -one.deviations : std::numeric_limits<double>::infinity());
      if (!std::isfinite(one.deviations) || (largest && one.deviations <= largest->deviations)) continue;
      const Quantity output = measured_quantity(scenes[i].output.empty() ? a.resistance->output : scenes[i].output);
      const Body body = body_of(scenes[i].scene);
      one.unit = output.unit_for(body);
      for (const DesignRange& range : space.ranges) {
        const double value = real_input(scenes[i].scene, range.key);
        one.inputs.emplace_back(range.key, value);
        one.where += (one.where.empty() ? " at " : ", ") + range.key + " = " +
                     readable(value, find_input(range.key)->quantity.unit_for(body));
      }
      one.where = std::string(output.key) + one.where;
      if (space.sets.size() > 1) one.where += ", of data " + scenes[i].set;
      largest = one;
    }
    return values;
  });
  return largest;
}

}  // namespace

FitComparison compare(const std::vector<FitCandidate>& fits, const Evaluate& evaluate, int jobs) {
  for (const FitCandidate& fit : fits) require_comparable(fits.front(), fit);
  const bool any_noise = any_of(fits, has_fitted_noise);
  FitComparison answer;
  std::vector<std::size_t> order;
  for (const FitCandidate& fit : fits) {
    order.push_back(order.size());
    answer.fits.push_back(compared(fit, any_noise));
  }
  stable_sort(order, [&](std::size_t a, std::size_t b) { return answer.fits[a].aicc < answer.fits[b].aicc; });
  stable_sort(answer.fits, [](const ComparedFit& a, const ComparedFit& b) { return a.aicc < b.aicc; });
  double sum = 0;
  const double least = answer.fits.front().aicc;
  for (ComparedFit& fit : answer.fits) sum += fit.weight = fit.aicc == least ? 1 : std::exp(0.5 * (least - fit.aicc));
  for (ComparedFit& fit : answer.fits) fit.weight /= sum;
  answer.ratios = likelihood_ratios(fits, any_noise);
  const FitCandidate &best = fits[order[0]], &next = fits[order[1]];
  if (best.material && next.material) answer.difference = material_difference(best, next);
  if (best.resistance && next.resistance) {
    answer.difference = scene_difference(best, next);
    if (evaluate) answer.next = next_difference(best, next, evaluate, jobs);
  }
  return answer;
}

std::string comparison_summary(const FitComparison& comparison) {
  std::ostringstream text;
  const auto number = [](double value) { return std::isfinite(value) ? short_number(value, 5) : std::string("-"); };
  Table table{{"fit", "model", "parameters", "chi squared", "AICc", "above best", "weight", "BIC", "status"}, {}};
  for (const ComparedFit& fit : comparison.fits)
    table.rows.push_back({fit.name, fit.model, std::int64_t{fit.parameters}, number(fit.chi_squared), number(fit.aicc),
                          number(fit.aicc - comparison.fits.front().aicc), percent(fit.weight), number(fit.bic),
                          fit.status});
  write_aligned(text, table);
  text << '\n';
  for (const LikelihoodRatio& ratio : comparison.ratios)
    text << ratio.small << " is a case of " << ratio.large << ": chi squared of the likelihood ratio "
         << number(ratio.rise) << " for " << ratio.degrees << (ratio.degrees == 1 ? " parameter" : " parameters")
         << " more, p = " << number(ratio.p_value) << '\n';
  if (const auto& most = comparison.difference)
    text << "the two best differ most, by " << short_number(most->deviations, 3) << " deviations, in " << most->where
         << ": " << most->first << " " << readable(most->values[0], most->unit) << ", " << most->second << " "
         << readable(most->values[1], most->unit) << '\n';
  if (const auto& next = comparison.next)
    text << "next measurement to tell them apart, by " << short_number(next->deviations, 3)
         << " deviations of it and of both predictions: " << next->where << ": " << next->first << " "
         << readable(next->values[0], next->unit) << ", " << next->second << " "
         << readable(next->values[1], next->unit) << '\n';
  return text.str();
}

Json json_of(const FitComparison& comparison) {
  Json object = json_object("best", comparison.fits.front().name, "fits", Json::array(), "likelihood_ratios",
                            Json::array(), "largest_difference", nullptr, "next_measurement", nullptr);
  for (const ComparedFit& fit : comparison.fits)
    object["fits"].push_back(json_object("fit", fit.name, "model", fit.model, "status", fit.status, "parameters",
                                         fit.parameters, "chi_squared", fit.chi_squared, "aicc", fit.aicc, "bic",
                                         fit.bic, "weight", fit.weight));
  for (const LikelihoodRatio& ratio : comparison.ratios)
    object["likelihood_ratios"].push_back(json_object("fit", ratio.small, "case_of", ratio.large, "rise", ratio.rise,
                                                      "degrees", ratio.degrees, "p_value", ratio.p_value));
  const auto difference_json = [](const LargestDifference& one) {
    Json difference = json_object("where", one.where, "fits", Json::array({one.first, one.second}), "values",
                                  Json::array({finite_or_null(one.values[0]), finite_or_null(one.values[1])}),
                                  "deviations", one.deviations);
    for (const auto& [key, value] : one.inputs) difference["inputs"][key] = finite_or_null(value);
    return difference;
  };
  if (comparison.difference) object["largest_difference"] = difference_json(*comparison.difference);
  if (comparison.next) object["next_measurement"] = difference_json(*comparison.next);
  return object;
}

}  // namespace rollres
