#include "studies/fit/fit_summary.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

#include "core/scene/scene_input.hpp"
#include "studies/run/progress.hpp"
#include "studies/scene_io/cells.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/table_json.hpp"
#include "studies/text/table_output.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

std::string_view unit_of(const FittedParameter& fitted, const FitContext& context) {
  return fitted.parameter.variable.quantity.unit_for(context.indenter);
}

std::string interval_text(const ConfidenceInterval& interval, std::string_view unit) {
  if (std::isnan(interval.lowest) && std::isnan(interval.highest)) return "-";
  const auto end = [&](double value, IntervalEnd kind) {
    return kind == IntervalEnd::open ? std::string("open") : readable(value, unit);
  };
  return end(interval.lowest, interval.low) + " .. " + end(interval.highest, interval.high);
}

/// The standard error over the value [1].
double over_value(const FittedParameter& fitted) { return fitted.standard_error / std::abs(fitted.value); }

/// 95 %, symmetric in the logarithm.
ConfidenceInterval interval_of(const LikelyNoise& noise) {
  const double factor = std::exp(1.96 * noise.standard_error / noise.value);
  return {noise.value / factor, noise.value * factor, IntervalEnd::closed, IntervalEnd::closed};
}

std::string_view noise_flag(const LikelyNoise& noise) {
  return noise.value > 0 ? "noise, by likelihood" : "noise that explains nothing";
}

Table parameter_table(const FitReport& report, const FitContext& context) {
  Table table{{"parameter", "value", "+-", "relative", "95 % linear", "95 % profile", "start", "flag"}, {}};
  for (const FittedParameter& fitted : report.parameters) {
    const std::string_view unit = unit_of(fitted, context);
    const bool profile = !fitted.profile.points.empty();
    table.rows.push_back({fitted.parameter.name, readable(fitted.value, unit), readable(fitted.standard_error, unit),
                          percent(over_value(fitted)), interval_text(fitted.linear, unit),
                          profile ? interval_text(fitted.profile.interval, unit) : std::string("-"),
                          readable(fitted.parameter.start, unit), fitted.flag});
  }
  for (const LikelyNoise& noise : report.noise_terms) {
    const std::string_view unit = noise.relative ? "1" : context.output_unit;
    const ConfidenceInterval interval = interval_of(noise);
    table.rows.push_back({noise.name, readable(noise.value, unit), readable(noise.standard_error, unit),
                          percent(noise.standard_error / noise.value), interval_text(interval, unit), std::string("-"),
                          std::string("-"), std::string(noise_flag(noise))});
  }
  for (const FitContext::Fixed& fixed : context.fixed)
    table.rows.push_back({fixed.name, readable(fixed.value, fixed.unit), std::string("-"), std::string("-"),
                          std::string("-"), std::string("-"), std::string("-"), std::string("fixed")});
  return table;
}

/// Pairs whose correlation is known and above `least`, the strongest first.
std::vector<FitCorrelationRecord> correlations_of(const FitReport& report, double least) {
  std::vector<FitCorrelationRecord> pairs;
  const Eigen::MatrixXd& all = report.errors.correlations;
  for (Eigen::Index j = 0; j < all.rows(); ++j)
    for (Eigen::Index k = j + 1; k < all.cols(); ++k)
      if (std::abs(all(j, k)) > least)
        pairs.push_back({report.parameters[static_cast<std::size_t>(j)].parameter.name,
                         report.parameters[static_cast<std::size_t>(k)].parameter.name, all(j, k)});
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const auto& a, const auto& b) { return std::abs(a.correlation) > std::abs(b.correlation); });
  return pairs;
}

void write_statistics(std::ostream& text, const FitReport& report, const FitContext& context) {
  const auto line = [&](const char* name, const std::string& words) {
    text << "  " << padded(name, 20) << words << '\n';
  };
  const auto number = [](double value) { return std::isfinite(value) ? short_number(value, 4) : std::string("-"); };
  line("data", std::to_string(report.values.size()) + " values, " + std::to_string(report.degrees) +
                   " degrees of freedom, digest " + context.data_digest.substr(0, 12));
  line("deviations", report.deviations_known       ? "as given (absolute)"
                     : !report.noise_terms.empty() ? "by the fitted noise"
                                                   : "not given: errors are scaled by the reduced chi squared");
  line("chi squared", number(report.chi_squared) + ", reduced " + number(report.reduced_chi_squared) +
                          (std::isnan(report.p_value) ? "" : ", p = " + number(report.p_value)));
  line("rms", (context.output_unit.empty() ? "" : readable(report.rms, context.output_unit) + ", ") + "relative " +
                  percent(report.relative_rms));
  if (!report.values.empty()) {
    const FittedValue& worst = report.values[report.largest_residual];
    line("largest residual", short_number(worst.residual, 3) + " deviations" +
                                 (worst.measured.place.empty() ? "" : " at " + worst.measured.place));
  }
  line("runs test",
       "p = " + number(report.runs_p_value) + "; in the order of the predicted values " + number(report.trend_p_value));
  line("condition", number(report.errors.condition) +
                        (report.weakest_direction.empty() ? "" : "; weakest: " + report.weakest_direction));
  line("noise of the model", number(report.noise) + " (relative)");
  std::vector<std::string> steps;  // parameters whose slopes are known have none
  for (const FittedParameter& fitted : report.parameters)
    if (std::isfinite(fitted.step)) steps.push_back(fitted.parameter.name + " " + number(fitted.step));
  if (!steps.empty()) line("steps (scaled)", joined(steps));
  line("descents", std::to_string(report.agreeing) + " of " + std::to_string(report.starts) +
                       " starts agree; the best took " + std::to_string(report.iterations) + " iterations");
  line("evaluations", std::to_string(report.evaluations) + ": " + std::to_string(context.solved) + " solved, " +
                          std::to_string(context.recalled) + " recalled, " + std::to_string(report.failures) +
                          " failed, in " + duration_in_words(context.seconds));
}

Json number(double value) { return json_of(cell_of(value)); }

Json interval_json(const ConfidenceInterval& interval) {
  return {{"lowest", interval.low == IntervalEnd::open ? Json(nullptr) : number(interval.lowest)},
          {"highest", interval.high == IntervalEnd::open ? Json(nullptr) : number(interval.highest)},
          {"low", name_of(interval.low)},
          {"high", name_of(interval.high)}};
}

Json parameter_json(const FittedParameter& fitted, const FitContext& context) {
  const Variable& variable = fitted.parameter.variable;
  Json object{{"name", fitted.parameter.name},
              {"unit", variable.quantity.unit_for(context.indenter)},
              {"value", number(fitted.value)},
              {"standard_error", number(fitted.standard_error)},
              {"relative_error", number(over_value(fitted))},
              {"linear_interval", interval_json(fitted.linear)},
              {"profile_interval", nullptr},
              {"start", number(fitted.parameter.start)},
              {"lowest", finite_or_null(variable.lowest)},
              {"highest", finite_or_null(variable.highest)},
              {"scale", name_of(variable.scaling)},
              {"step", number(fitted.step)},
              {"slope_doubt", number(fitted.slope_doubt)},
              {"flag", fitted.flag}};
  if (fitted.profile.points.empty()) return object;
  object["profile_interval"] = interval_json(fitted.profile.interval);
  object["profile"] = Json::array();
  for (const ProfilePoint& point : fitted.profile.points)
    object["profile"].push_back({{"value", number(point.value)}, {"rise", number(point.rise)}});
  return object;
}

Json after_json(const MeasurementPlan& plan, const Eigen::VectorXd& deviations) {
  Json after = Json::object();
  for (std::size_t k = 0; k < plan.aims.size(); ++k)
    after[plan.aims[k].name] = deviations[static_cast<Eigen::Index>(k)];
  return after;
}

std::vector<std::size_t> places_of_best(const MeasurementPlan& plan) {
  std::vector<std::size_t> places(std::min(best_shown, plan.choices.size()));
  std::iota(places.begin(), places.end(), 0);
  return places;
}

/// @param inputs  that are told beside speed and load
Json choices_json(const MeasurementPlan& design, const std::vector<std::size_t>& places,
                  const std::vector<std::string>& inputs = {}) {
  Json choices = Json::array();
  for (const std::size_t place : places) {
    const DesignChoice& choice = design.choices[place];
    choices.push_back({{"speed", choice.scene.speed},
                       {"load", choice.scene.load ? Json(*choice.scene.load) : Json(nullptr)},
                       {"data", choice.set},
                       {"predicted", choice.predicted},
                       {"deviation", choice.deviation},
                       {"relative_errors", after_json(design, choice.deviations)},
                       {"ratio", design.ratio(choice)}});
    for (const std::string& key : inputs) choices.back()[key] = real_input(choice.scene, key);
  }
  return choices;
}

Json together_json(const FitDesign& design, const JointChoice& joint) {
  Json measured = Json::array();
  for (const std::size_t place : joint.choices) {
    const DesignChoice& choice = design.anywhere.choices[place];
    Json& one = measured.emplace_back(Json{{"data", choice.set}});
    for (const std::string& key : design.inputs) one[key] = real_input(choice.scene, key);
  }
  return {{"measurements", measured}, {"relative_errors", after_json(design.anywhere, joint.deviations)}};
}

}  // namespace

std::string fit_summary(const FitReport& report, const FitContext& context) {
  std::ostringstream text;
  text << context.name << ": " << name_of(report.status) << '\n';
  if (!report.reason.empty()) text << "reason   " << report.reason << '\n';
  for (const auto* const warnings : {&report.warnings, &context.data_warnings})
    for (const std::string& warning : *warnings) text << "warning  " << warning << '\n';
  for (const std::string& note : context.notes) text << "model    " << note << '\n';
  for (const EvaluationLog::Failure& failure : report.failure_reasons)
    text << "failed   " << failure.count << " x " << failure.reason << " (first " << failure.first_place << ")\n";
  text << '\n';
  write_aligned(text, parameter_table(report, context));
  if (report.values.empty()) return text.str();
  text << '\n';
  write_statistics(text, report, context);
  const std::vector<FitCorrelationRecord> pairs = correlations_of(report, 0.1);
  if (pairs.empty()) return text.str();
  constexpr std::size_t most_shown = 12;
  text << "\ncorrelations above 0.1"
       << (pairs.size() > most_shown ? ", the " + std::to_string(most_shown) + " strongest of " +
                                           std::to_string(pairs.size()) + " (--json has all)"
                                     : "")
       << '\n';
  std::size_t widest = 42;
  const std::size_t shown = std::min(most_shown, pairs.size());
  for (std::size_t i = 0; i < shown; ++i) widest = std::max(widest, width(pairs[i].first + ", " + pairs[i].second));
  for (std::size_t i = 0; i < shown; ++i)
    text << "  " << padded(pairs[i].first + ", " + pairs[i].second, widest + 2) << short_number(pairs[i].correlation, 4)
         << '\n';
  return text.str();
}

std::string coverage_summary(const Coverage& coverage) {
  std::ostringstream text;
  text << "\ncoverage: " << coverage.fitted << " of " << coverage.draws << " draws fitted, seed " << coverage.seed
       << "\n";
  Table table{{"parameter", "truth", "95 % linear holds", "95 % profile holds", "mean offset", "scatter"}, {}};
  const auto part = [&](int count) { return percent(static_cast<double>(count) / std::max(1, coverage.fitted)); };
  for (const ParameterCoverage& count : coverage.parameters)
    table.rows.push_back({count.name, count.truth, part(count.linear),
                          coverage.profiles ? part(count.profile) : std::string("-"), count.mean_offset,
                          count.offset_scatter});
  write_aligned(text, table);
  for (const std::string& failure : coverage.failures) text << "not fitted: " << failure << '\n';
  return text.str();
}

namespace {

/// What pictures need: profiles, axes, curves, and where the data lie.
void add_pictured(FitRecord& record, const FitReport& report, const FitCurves& curves) {
  for (const FittedParameter& fitted : report.parameters)
    for (const ProfilePoint& point : fitted.profile.points)
      record.profiles.push_back({fitted.parameter.name, point.value, point.rise});
  if (!record.profiles.empty()) record.profile_threshold = interval_threshold(report.deviations_known, report.degrees);
  if (curves.curves.empty()) return;
  record.x_name = curves.x.name;
  record.x_unit = curves.x.unit;
  record.x_logarithmic = curves.x.logarithmic;
  record.y_name = curves.y.name;
  record.y_unit = curves.y.unit;
  record.y_logarithmic = curves.y.logarithmic;
  for (std::size_t k = 0; k < curves.curves.size(); ++k) {
    const FitCurve& curve = curves.curves[k];
    const auto number = static_cast<std::int64_t>(k);
    for (std::size_t i = 0; i < curve.x.size(); ++i)
      record.curves.push_back({number, curve.label, curve.x[i], curve.value[i], curve.band[i]});
    for (std::size_t i = 0; i < curve.data.size(); ++i) {
      record.data[curve.data[i]].x = curve.data_x[i];
      record.data[curve.data[i]].curve = number;
    }
  }
}

}  // namespace

FitRecord fit_record(const FitReport& report, const FitContext& context) {
  FitRecord record;
  record.name = context.name;
  record.kind = context.kind;
  record.definition = context.definition;
  record.data_digest = context.data_digest;
  record.status = name_of(report.status);
  record.reason = report.reason;
  for (const auto* const warnings : {&report.warnings, &context.data_warnings})
    for (const std::string& warning : *warnings) record.warnings += (record.warnings.empty() ? "" : "\n") + warning;
  record.weakest_direction = report.weakest_direction;
  record.scene = context.scene;
  record.degrees = report.degrees;
  record.starts = report.starts;
  record.agreeing = report.agreeing;
  record.evaluations = static_cast<std::int64_t>(report.evaluations);
  record.recalled = static_cast<std::int64_t>(context.recalled);
  record.failures = static_cast<std::int64_t>(report.failures);
  record.chi_squared = report.chi_squared;
  record.reduced_chi_squared = report.reduced_chi_squared;
  record.p_value = report.p_value;
  record.rms = report.rms;
  record.runs_p_value = report.runs_p_value;
  record.condition = report.errors.condition;
  record.noise = report.noise;
  record.seconds = context.seconds;
  record.deviations_known = report.deviations_known;
  for (const FittedParameter& fitted : report.parameters) {
    const Variable& variable = fitted.parameter.variable;
    FitParameterRecord& row =
        record.parameters.emplace_back(FitParameterRecord{.name = fitted.parameter.name,
                                                          .unit = std::string(unit_of(fitted, context)),
                                                          .value = fitted.value,
                                                          .standard_error = fitted.standard_error,
                                                          .relative_error = over_value(fitted),
                                                          .linear_lowest = fitted.linear.lowest,
                                                          .linear_highest = fitted.linear.highest,
                                                          .start = fitted.parameter.start,
                                                          .lowest = variable.lowest,
                                                          .highest = variable.highest,
                                                          .step = fitted.step,
                                                          .flag = fitted.flag});
    const ConfidenceInterval& profile = fitted.profile.interval;
    if (profile.low != IntervalEnd::open) row.profile_lowest = profile.lowest;
    if (profile.high != IntervalEnd::open) row.profile_highest = profile.highest;
    if (fitted.profile.points.empty()) continue;
    row.profile_low = name_of(profile.low);
    row.profile_high = name_of(profile.high);
  }
  for (const LikelyNoise& noise : report.noise_terms)  // nothing that a scene could be given
    record.parameters.push_back({.name = noise.name,
                                 .unit = std::string(noise.relative ? "1" : context.output_unit),
                                 .fixed = true,
                                 .value = noise.value,
                                 .standard_error = noise.standard_error,
                                 .relative_error = noise.standard_error / noise.value,
                                 .flag = std::string(noise_flag(noise))});
  for (const FitContext::Fixed& fixed : context.fixed)
    record.parameters.push_back(
        {.name = fixed.name, .unit = fixed.unit, .fixed = true, .value = fixed.value, .flag = "fixed"});
  record.correlations = correlations_of(report, 0);
  for (const FittedValue& value : report.values)
    record.data.push_back({value.measured.place, value.measured.value, value.measured.deviation, value.predicted,
                           value.residual, value.band});
  if (!record.data.empty()) record.inputs = context.inputs;
  add_pictured(record, report, context.curves);
  return record;
}

Json json_of(const FitReport& report, const FitContext& context) {
  const FitRecord record = fit_record(report, context);
  Json warnings = report.warnings;
  for (const std::string& warning : context.data_warnings) warnings.push_back(warning);
  Json object{{"fit", record.name},
              {"kind", record.kind},
              {"status", record.status},
              {"reason", record.reason},
              {"warnings", warnings},
              {"model", context.notes},
              {"data_digest", record.data_digest},
              {"values", report.values.size()},
              {"deviations", report.deviations_known ? "absolute" : "scaled by the reduced chi squared"},
              {"degrees", report.degrees},
              {"chi_squared", number(report.chi_squared)},
              {"reduced_chi_squared", number(report.reduced_chi_squared)},
              {"p_value", number(report.p_value)},
              {"rms", number(report.rms)},
              {"relative_rms", number(report.relative_rms)},
              {"runs_p_value", number(report.runs_p_value)},
              {"condition", number(report.errors.condition)},
              {"weakest_direction", report.weakest_direction},
              {"noise", number(report.noise)},
              {"starts", report.starts},
              {"agreeing", report.agreeing},
              {"iterations", report.iterations},
              {"stopped", report.stopped},
              {"interrupted", report.interrupted},
              {"misfit_cause", report.misfit_cause},
              {"second_best", report.second_best},
              {"trend_p_value", number(report.trend_p_value)},
              {"evaluations", report.evaluations},
              {"solved", context.solved},
              {"recalled", context.recalled},
              {"failed", report.failures},
              {"seconds", context.seconds},
              {"scene", context.scene.empty() ? Json(nullptr) : Json::parse(context.scene)},
              {"parameters", Json::array()},
              {"noise_terms", Json::array()},
              {"fixed", Json::array()},
              {"correlations", Json::array()},
              {"failures", Json::array()},
              {"data", Json::array()}};
  for (const FittedParameter& fitted : report.parameters)
    object["parameters"].push_back(parameter_json(fitted, context));
  for (const LikelyNoise& noise : report.noise_terms)
    object["noise_terms"].push_back({{"name", noise.name},
                                     {"unit", noise.relative ? "1" : context.output_unit},
                                     {"value", number(noise.value)},
                                     {"standard_error", number(noise.standard_error)},
                                     {"interval", interval_json(interval_of(noise))}});
  for (const FitContext::Fixed& fixed : context.fixed)
    object["fixed"].push_back({{"name", fixed.name}, {"unit", fixed.unit}, {"value", fixed.value}});
  for (const FitCorrelationRecord& pair : record.correlations)
    object["correlations"].push_back(
        {{"first", pair.first}, {"second", pair.second}, {"correlation", number(pair.correlation)}});
  for (const EvaluationLog::Failure& failure : report.failure_reasons)
    object["failures"].push_back(
        {{"reason", failure.reason}, {"count", failure.count}, {"first_place", failure.first_place}});
  for (const FittedValue& value : report.values)
    object["data"].push_back({{"place", value.measured.place},
                              {"measured", number(value.measured.value)},
                              {"deviation", report.deviations_known ? number(value.measured.deviation) : Json(nullptr)},
                              {"predicted", number(value.predicted)},
                              {"residual", number(value.residual)},
                              {"band", number(value.band)}});
  return object;
}

Json json_of(const FitDesign& design) {
  Json sequence = Json::array();
  for (const JointChoice& joint : design.together) sequence.push_back(together_json(design, joint));
  const MeasurementPlan& plan = design.speeds;
  return {{"worst", plan.aims[plan.worst].name},
          {"relative_error", number(plan.deviations[static_cast<Eigen::Index>(plan.worst)])},
          {"relative_errors", after_json(plan, plan.deviations)},
          {"speeds", choices_json(design.speeds, places_of_best(design.speeds))},
          {"loads", choices_json(design.loads, places_of_best(design.loads))},
          {"anywhere", choices_json(design.anywhere, design.best, design.inputs)},
          {"sequence", sequence},
          {"together", sequence.empty() ? Json(nullptr) : sequence.back()}};
}

Json json_of(const Coverage& coverage) {
  Json object{{"draws", coverage.draws},
              {"fitted", coverage.fitted},
              {"seed", coverage.seed},
              {"parameters", Json::array()},
              {"failures", coverage.failures}};
  for (const ParameterCoverage& parameter : coverage.parameters)
    object["parameters"].push_back({{"name", parameter.name},
                                    {"truth", parameter.truth},
                                    {"linear", parameter.linear},
                                    {"profile", coverage.profiles ? Json(parameter.profile) : Json(nullptr)},
                                    {"mean_offset", number(parameter.mean_offset)},
                                    {"offset_scatter", number(parameter.offset_scatter)}});
  return object;
}

}  // namespace rollres
