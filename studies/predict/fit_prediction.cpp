#include "studies/predict/fit_prediction.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/scene/scene_input.hpp"
#include "fitting/errors/statistics.hpp"
#include "fitting/fit/experiment_design.hpp"
#include "fitting/fit/fit.hpp"
#include "fitting/fit/noise_fit.hpp"
#include "studies/scene_io/scene_inputs.hpp"

namespace rollres {

namespace {

double median_of(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + std::ssize(values) / 2, values.end());
  return values[values.size() / 2];
}

/// The largest over the smallest.
double spread_of(const std::vector<double>& values) {
  const auto [least, most] = minmax_element(values);
  return *most / *least;
}

bool acts_on(const ParameterName& name, const std::string& set) { return name.set.empty() || name.set == set; }

/// What the fit knows of the parameters of some scenes.
struct FitKnowledge {
  std::vector<FittedInput> inputs = {};
  std::vector<double> values = {}, errors = {};  ///< [SI]; an error is 0 where a bound holds the parameter
  Eigen::MatrixXd correlations = {};
};

FitKnowledge knowledge_of(const FitRecord& fit, const std::vector<AskedScene>& scenes) {
  FitKnowledge known;
  std::vector<std::string> names;
  for (const FitParameterRecord& one : fit.parameters) {
    const ParameterName name = parameter_name(one.name);
    if (one.fixed || none_of(scenes, [&](const AskedScene& asked) { return acts_on(name, asked.scene.set); })) continue;
    FittedInput input{{name.key}, one.value, name.set};
    if (std::isfinite(one.lowest)) input.input.lowest = one.lowest;
    if (std::isfinite(one.highest)) input.input.highest = one.highest;
    if (!one.scale.empty() && !is_measured_term(name.key)) input.input.logarithmic = one.scale == "logarithmic";
    known.inputs.push_back(input);
    known.values.push_back(one.value);
    known.errors.push_back(std::isnan(one.standard_error) ? 0 : one.standard_error);
    names.push_back(one.name);
  }
  const auto count = std::ssize(names);
  known.correlations = Eigen::MatrixXd::Identity(count, count);
  for (const FitCorrelationRecord& pair : fit.correlations)
    for (Eigen::Index j = 0; j < count; ++j)
      for (Eigen::Index k = 0; k < count; ++k)
        if (names[static_cast<std::size_t>(j)] == pair.first && names[static_cast<std::size_t>(k)] == pair.second)
          known.correlations(j, k) = known.correlations(k, j) = pair.correlation;
  return known;
}

}  // namespace

ParameterName parameter_name(const std::string& name) {
  const std::size_t bracket = name.find(" (");
  if (bracket == std::string::npos || !name.ends_with(')')) return {name, ""};
  return {name.substr(0, bracket), name.substr(bracket + 2, name.size() - bracket - 3)};
}

std::vector<FitParameterRecord> parameters_of(const FitRecord& fit, const std::string& set) {
  std::vector<FitParameterRecord> own;
  for (const FitParameterRecord& one : fit.parameters)
    if (!one.fixed && acts_on(parameter_name(one.name), set)) own.push_back(one);
  return own;
}

Instrument instrument_of(const FitRecord& fit, const std::string& set) {
  Instrument instrument;
  for (const FitParameterRecord& one : parameters_of(fit, set)) {
    const std::string key = parameter_name(one.name).key;
    if (key == offset_key) instrument.offset += one.value;
    if (key == scale_key) instrument.scale *= one.value;
  }
  return instrument;
}

void assign_fitted(RollingScene& scene, const FitRecord& fit, const std::string& set) {
  for (const FitParameterRecord& one : parameters_of(fit, set))
    if (const std::string key = parameter_name(one.name).key; !is_measured_term(key)) set_input(scene, key, one.value);
}

MeasurementNoise measurement_noise(const FitRecord& fit, const std::string& set, double reading) {
  double variance = 0, errors = 0;
  bool fitted = false;
  for (const FitParameterRecord& one : fit.parameters) {
    if (!one.noise) continue;
    const ParameterName name = parameter_name(one.name);
    if (!acts_on(name, set)) continue;
    const double share = name.key == relative_noise_key ? reading * reading : 1;
    const bool told = one.standard_error < one.value;
    const double size =
        told || std::isnan(one.linear_highest) ? one.value : std::max(one.value, one.linear_highest / 2);
    variance += size * size * share;
    if (told) errors += std::pow(2 * size * one.standard_error * share, 2);
    fitted = true;
  }
  if (fitted) return {variance, std::sqrt(errors)};
  std::vector<double> absolute, relative;
  for (const FitDataRecord& one : fit.data) {
    if (!fit.x_name.empty() && one.curve < 0) continue;  // of another output, or known before
    if (!(one.deviation > 0) || one.measured == 0) continue;
    absolute.push_back(one.deviation);
    relative.push_back(one.deviation / std::abs(one.measured));
  }
  if (absolute.empty()) return {};
  const double deviation =
      spread_of(absolute) < spread_of(relative) ? median_of(absolute) : median_of(relative) * std::abs(reading);
  if (fit.deviations_known) return {deviation * deviation};
  const double scattered = deviation * deviation * fit.reduced_chi_squared;
  return {scattered, scattered * std::sqrt(2.0 / static_cast<double>(fit.degrees))};
}

namespace {

/// The two-sided 95 % quantile for an estimate whose variance is so uncertain: 0: not at all.
double quantile_for(double variance, double error) {
  constexpr double rounding = 1e-6, as_good_as_normal = 1e6;
  constexpr int fewest = 4;  // below it the error of a variance says no more than that little is known
  const double degrees = 2 * std::pow(variance / error, 2);
  if (!(degrees < as_good_as_normal)) return two_sided_quantile(confidence, 0);
  return two_sided_quantile(confidence, std::max(fewest, static_cast<int>(degrees + rounding)));
}

}  // namespace

std::vector<PredictedScene> predicted(const FitRecord& fit, const std::string& output,
                                      const std::vector<AskedScene>& asked, PredictedAs as, const Evaluate& evaluate,
                                      int jobs) {
  if (fit.kind != "resistance")
    throw std::invalid_argument(fit.name + ": only a fit of scenes can predict; this is a fit of a " + fit.kind);
  const FitKnowledge known = knowledge_of(fit, asked);
  std::vector<MeasuredScene> scenes;
  for (const AskedScene& one : asked) {
    scenes.push_back(one.scene);
    assign_fitted(scenes.back().scene, fit, one.scene.set);
    scenes.back().output = output;
    scenes.back().measured = {.value = 1, .deviation = 1, .place = one.scene.measured.place};
  }
  const std::vector<FitParameter> parameters = fit_parameters(scenes, known.inputs);
  const std::vector<ScenePrediction> found =
      predictions_at(parameters, known.values, known.inputs, scenes, evaluate, {.output = output, .jobs = jobs});
  const double doubt = fit.deviations_known ? 0 : std::sqrt(2.0 / static_cast<double>(fit.degrees));  // of variances
  std::vector<PredictedScene> answer;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const Instrument instrument = instrument_of(fit, scenes[i].set);
    double value = found[i].value;
    Eigen::VectorXd share = found[i].slope;
    for (std::size_t j = 0; j < known.values.size(); ++j) {
      double& one = share[static_cast<Eigen::Index>(j)];
      const bool left_out = as == PredictedAs::true_value && is_measured_term(known.inputs[j].input.key);
      // A slope of 0 is that of a parameter of another data set, whatever its error.
      one = left_out || one == 0 ? 0 : one * known.errors[j] / parameters[j].variable.slope(known.values[j]);
    }
    if (as == PredictedAs::true_value) {
      value = (value - instrument.offset) / instrument.scale;
      share /= instrument.scale;
    }
    double variance = std::max(0.0, share.dot(known.correlations * share)), uncertain = doubt * variance;
    if (as == PredictedAs::measurement) {
      const double own = asked[i].deviation;
      const MeasurementNoise noise =
          std::isfinite(own) ? MeasurementNoise{own * own} : measurement_noise(fit, scenes[i].set, value);
      variance += noise.variance;
      uncertain += noise.error;
    }
    const double quantile = quantile_for(variance, uncertain);
    const double error = std::isfinite(value) ? std::sqrt(variance) : RollingSolution::absent;
    answer.push_back({value, error, value - quantile * error, value + quantile * error});
  }
  return answer;
}

}  // namespace rollres
