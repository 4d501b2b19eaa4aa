#include "studies/fit/fit_record.hpp"

#include <cmath>
#include <utility>

#include "fitting/fit/fit.hpp"
#include "studies/scene_io/scene_inputs.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

/// Pairs whose correlation is known, the strongest first.
std::vector<FitCorrelationRecord> correlations_of(const FitReport& report) {
  std::vector<FitCorrelationRecord> pairs;
  const Eigen::MatrixXd& all = report.errors.correlations;
  for (Eigen::Index j = 0; j < all.rows(); ++j)
    for (Eigen::Index k = j + 1; k < all.cols(); ++k)
      if (std::abs(all(j, k)) > 0)
        pairs.push_back({report.parameters[static_cast<std::size_t>(j)].parameter.name,
                         report.parameters[static_cast<std::size_t>(k)].parameter.name, all(j, k)});
  stable_sort(pairs, [](const auto& a, const auto& b) { return std::abs(a.correlation) > std::abs(b.correlation); });
  return pairs;
}

FitParameterRecord fitted_row(const FittedParameter& fitted, Body body) {
  const Variable& variable = fitted.parameter.variable;
  const ConfidenceInterval& profile = fitted.profile.interval;
  FitParameterRecord row{.name = fitted.parameter.name,
                         .unit = std::string(variable.quantity.unit_for(body)),
                         .value = fitted.value,
                         .standard_error = fitted.standard_error,
                         .relative_error = fitted.standard_error / std::abs(fitted.value),
                         .linear_lowest = fitted.linear.lowest,
                         .linear_highest = fitted.linear.highest,
                         .linear_low = std::string(name_of(fitted.linear.low)),
                         .linear_high = std::string(name_of(fitted.linear.high)),
                         .start = fitted.parameter.start,
                         .lowest = variable.lowest,
                         .highest = variable.highest,
                         .scale = std::string(name_of(variable.scaling)),
                         .step = fitted.step,
                         .slope_doubt = fitted.slope_doubt,
                         .flag = fitted.flag};
  if (profile.low != IntervalEnd::open) row.profile_lowest = profile.lowest;
  if (profile.high != IntervalEnd::open) row.profile_highest = profile.highest;
  if (fitted.profile.points.empty()) return row;
  row.profile_low = name_of(profile.low);
  row.profile_high = name_of(profile.high);
  return row;
}

/// With the 95 % interval: symmetric in the logarithm, or from 0 on.
FitParameterRecord noise_row(const LikelyNoise& noise, const std::string& output_unit) {
  const bool present = noise.value > 0, told = noise.standard_error < noise.value;
  const double factor = std::exp(1.96 * noise.standard_error / noise.value);
  return {.name = noise.name,
          .unit = noise.relative ? "1" : output_unit,
          .fixed = true,
          .noise = true,
          .value = noise.value,
          .standard_error = noise.standard_error,
          .relative_error = noise.standard_error / noise.value,
          .linear_lowest = told ? noise.value / factor : 0,
          .linear_highest = told ? noise.value * factor : noise.highest,
          .linear_low = told ? "closed" : "limit",
          .linear_high = told || std::isfinite(noise.highest) ? "closed" : "open",
          .flag = present ? "noise, by likelihood" : "noise that explains nothing"};
}

constexpr const char* angular_frequency = "angular_frequency";

/// The unit of the measured values; empty where they are of several kinds.
std::string_view unit_of_all(const FitFile& file) {
  for (const MeasuredScene& row : file.scenes)
    if (row.output != file.scenes.front().output) return "";
  return measured_quantity(file.scenes.front().output).unit_for(file.body());
}

/// @param unit  of the measured values
template <class File>
FitRecord begun_of(const File& file, const char* kind, std::string_view unit) {
  return {.name = file.name,
          .kind = kind,
          .definition = file.definition,
          .data_digest = file.data_digest,
          .model = joined(file.notes, "\n"),
          .output_unit = std::string(unit),
          .inputs = measured_inputs(file)};
}

}  // namespace

std::vector<FitInputRecord> measured_inputs(const FitFile& file) {
  std::vector<FitInputRecord> inputs;
  for (std::size_t i = 0; i < file.scenes.size(); ++i) {
    const auto datum = static_cast<std::int64_t>(i + 1);
    const MeasuredScene& row = file.scenes[i];
    for (const std::string& key : file.varying) {
      const InputKind& kind = *find_input(key);
      const bool acts = !is_of_material(row.output) || key == "temperature";  // on a modulus nothing of the scene does
      if (kind.real() && acts)
        inputs.push_back({datum, key, std::string(kind.quantity.unit_for(file.body())), real_input(row.scene, key)});
    }
    if (is_curve(row.output))
      inputs.push_back({datum, "time", "s", row.time});
    else if (is_of_material(row.output))
      inputs.push_back({datum, angular_frequency, "rad/s", row.angular_frequency});
  }
  return inputs;
}

std::vector<FitInputRecord> measured_inputs(const MaterialFile& file) {
  std::vector<FitInputRecord> inputs;
  std::int64_t datum = 0;
  for (const MeasuredModulus& row : file.data)
    for (int modulus = 0; modulus < 2; ++modulus) {
      inputs.push_back({++datum, angular_frequency, "rad/s", row.angular_frequency});
      inputs.push_back({datum, "temperature", "K", row.temperature});
    }
  return inputs;
}

std::vector<FitInputRecord> measured_inputs(const ShiftFile& file) {
  std::vector<FitInputRecord> inputs;
  for (const MeasuredShift& row : file.data)
    inputs.push_back({std::ssize(inputs) + 1, "temperature", "K", row.temperature});
  return inputs;
}

std::vector<FitInputRecord> measured_inputs(const StrainFile& file) {
  std::vector<FitInputRecord> inputs;
  for (const MeasuredStrain& row : file.data)
    for (int modulus = 0; modulus < 2; ++modulus)
      inputs.push_back({std::ssize(inputs) + 1, "strain_amplitude", "1", row.amplitude});
  return inputs;
}

FitRecord begun_fit(const FitFile& file) {
  FitRecord fit = begun_of(file, "resistance", unit_of_all(file));
  fit.warnings = joined(file.warnings, "\n");
  for (const FixedInput& fixed : file.fixed)
    fit.parameters.push_back({.name = fixed.key,
                              .unit = std::string(find_input(fixed.key)->quantity.unit_for(file.body())),
                              .fixed = true,
                              .value = fixed.value,
                              .flag = "fixed"});
  return fit;
}

FitRecord begun_fit(const MaterialFile& file) { return begun_of(file, "material", "Pa"); }
FitRecord begun_fit(const ShiftFile& file) { return begun_of(file, "shift", "1"); }
FitRecord begun_fit(const StrainFile& file) { return begun_of(file, "strain", "Pa"); }

FitRecord with_report(FitRecord begun, const FitReport& report, Body body) {
  FitRecord fit = std::move(begun);
  const std::vector<FitParameterRecord> fixed = std::exchange(fit.parameters, {});
  std::vector<std::string> warnings = report.warnings;
  if (!fit.warnings.empty()) warnings.push_back(fit.warnings);
  fit.status = name_of(report.status);
  fit.reason = report.reason;
  fit.warnings = joined(warnings, "\n");
  fit.weakest_direction = report.weakest_direction;
  fit.second_best = report.second_best;
  fit.misfit_cause = report.misfit_cause;
  fit.stopped = report.stopped;
  fit.deviations_known = report.deviations_known;
  fit.interrupted = report.interrupted;
  fit.degrees = report.degrees;
  fit.starts = report.starts;
  fit.agreeing = report.agreeing;
  fit.iterations = report.iterations;
  fit.evaluations = static_cast<std::int64_t>(report.evaluations);
  fit.failures = static_cast<std::int64_t>(report.failures);
  fit.chi_squared = report.chi_squared;
  fit.reduced_chi_squared = report.reduced_chi_squared;
  fit.p_value = report.p_value;
  fit.rms = report.rms;
  fit.relative_rms = report.relative_rms;
  fit.runs_p_value = report.runs_p_value;
  fit.trend_p_value = report.trend_p_value;
  fit.condition = report.errors.condition;
  fit.noise = report.noise;
  for (const FittedParameter& fitted : report.parameters) {
    fit.parameters.push_back(fitted_row(fitted, body));
    for (const ProfilePoint& point : fitted.profile.points)
      fit.profiles.push_back({fitted.parameter.name, point.value, point.rise});
  }
  if (!fit.profiles.empty()) fit.profile_threshold = interval_threshold(report.deviations_known, report.degrees);
  for (const LikelyNoise& noise : report.noise_terms) fit.parameters.push_back(noise_row(noise, fit.output_unit));
  fit.parameters.insert(fit.parameters.end(), fixed.begin(), fixed.end());
  fit.correlations = correlations_of(report);
  for (const FittedValue& value : report.values)
    fit.data.push_back({value.measured.place, value.measured.value, value.measured.deviation, value.predicted,
                        value.residual, value.band});
  if (fit.data.empty()) fit.inputs.clear();
  for (const EvaluationLog::Failure& failure : report.failure_reasons)
    fit.failure_reasons.push_back({failure.reason, static_cast<std::int64_t>(failure.count), failure.first_place});
  return fit;
}

FitRecord with_curves(FitRecord fit, const FitCurves& curves) {
  if (curves.curves.empty()) return fit;
  fit.x_name = curves.x.name;
  fit.x_unit = curves.x.unit;
  fit.x_logarithmic = curves.x.logarithmic;
  fit.y_name = curves.y.name;
  fit.y_unit = curves.y.unit;
  fit.y_logarithmic = curves.y.logarithmic;
  for (std::int64_t number = 0; number < std::ssize(curves.curves); ++number) {
    const FitCurve& curve = curves.curves[static_cast<std::size_t>(number)];
    for (std::size_t i = 0; i < curve.x.size(); ++i)
      fit.curves.push_back({number, curve.label, curve.x[i], curve.value[i], curve.band[i]});
    for (std::size_t i = 0; i < curve.data.size(); ++i) {
      fit.data[curve.data[i]].x = curve.data_x[i];
      fit.data[curve.data[i]].curve = number;
    }
  }
  return fit;
}

}  // namespace rollres
