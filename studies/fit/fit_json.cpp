#include "studies/fit/fit_json.hpp"

#include "studies/scene_io/cells.hpp"
#include "studies/text/table_json.hpp"

namespace rollres {

namespace {

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
              {"relative_error", number(fitted.relative_error)},
              {"linear_interval", interval_json(fitted.linear)},
              {"profile_interval", nullptr},
              {"start", number(fitted.parameter.start)},
              {"lowest", finite_or_null(variable.lowest)},
              {"highest", finite_or_null(variable.highest)},
              {"scale", variable.logarithmic ? "logarithmic" : "linear"},
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

Json choices_json(const MeasurementPlan& design, const FitReport& report) {
  Json choices = Json::array();
  for (std::size_t i = 0; i < std::min(best_shown, design.choices.size()); ++i) {
    const DesignChoice& choice = design.choices[i];
    Json after = Json::object();
    for (std::size_t j = 0; j < report.parameters.size(); ++j)
      after[report.parameters[j].parameter.name] = choice.deviations[static_cast<Eigen::Index>(j)];
    choices.push_back({{"speed", choice.scene.speed},
                       {"load", choice.scene.load ? Json(*choice.scene.load) : Json(nullptr)},
                       {"data", choice.set},
                       {"predicted", choice.predicted},
                       {"deviation", choice.deviation},
                       {"relative_errors", after},
                       {"ratio", design.ratio(choice)}});
  }
  return choices;
}

}  // namespace

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
              {"evaluations", report.evaluations},
              {"solved", context.solved},
              {"recalled", context.recalled},
              {"failed", report.failures},
              {"seconds", context.seconds},
              {"parameters", Json::array()},
              {"fixed", Json::array()},
              {"correlations", Json::array()},
              {"failures", Json::array()},
              {"data", Json::array()}};
  for (const FittedParameter& fitted : report.parameters)
    object["parameters"].push_back(parameter_json(fitted, context));
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

Json json_of(const FitDesign& design, const FitReport& report) {
  return {{"worst", report.parameters[design.speeds.worst].parameter.name},
          {"relative_error", number(design.speeds.deviations[static_cast<Eigen::Index>(design.speeds.worst)])},
          {"speeds", choices_json(design.speeds, report)},
          {"loads", choices_json(design.loads, report)}};
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
