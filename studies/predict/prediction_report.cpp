#include "studies/predict/prediction_report.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "core/derivatives/objective.hpp"
#include "fitting/fit/fit.hpp"
#include "studies/scene_io/cells.hpp"
#include "studies/scene_io/scene_inputs.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/table_json.hpp"
#include "studies/text/table_output.hpp"
#include "studies/text/value_and_error.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

Body body_of_all(const FitPredictions& predictions) { return body_of(predictions.asked.scenes.front().scene.scene); }

std::string unit_of_all(const FitPredictions& predictions) {
  return std::string(measured_quantity(predictions.asked.output).unit_for(body_of_all(predictions)));
}

double input_at(const FitPredictions& predictions, std::size_t scene, const std::string& key) {
  const RollingScene& there = predictions.asked.scenes[scene].scene.scene;
  return key == "load" && !there.load ? missing : real_input(there, key);
}

bool varies(const FitPredictions& predictions, const std::string& key) {
  for (std::size_t i = 1; i < predictions.values.size(); ++i)
    if (input_at(predictions, i, key) != input_at(predictions, 0, key)) return true;
  return false;
}

std::string as_in_words(const FitRecord& fit, PredictedAs as) {
  const bool terms = any_of(
      fit.parameters, [](const FitParameterRecord& one) { return is_measured_term(parameter_name(one.name).key); });
  if (as == PredictedAs::true_value) return terms ? "the true value, without offset and scale" : "the true value";
  if (as == PredictedAs::reading) return "the reading, with offset and scale";
  return "one more measurement, with its noise";
}

/// The input that charts have along: the speed where it varies, else the first that does.
std::string along_of(const FitPredictions& predictions) {
  if (varies(predictions, "speed")) return "speed";
  for (const std::string& key : predictions.asked.inputs)
    if (varies(predictions, key)) return key;
  return "speed";
}

/// "P = 20 kN/m": the inputs that vary beside the one along.
std::string label_at(const FitPredictions& predictions, std::size_t scene, const std::string& along) {
  std::vector<std::string> parts;
  for (const std::string& key : predictions.asked.inputs) {
    if (key == along || !varies(predictions, key)) continue;
    const Quantity& quantity = find_input(key)->quantity;
    parts.push_back(std::string(quantity.symbol.empty() ? quantity.key : quantity.symbol) + " = " +
                    readable(quantity, input_at(predictions, scene, key), quantity.unit_for(body_of_all(predictions))));
  }
  return joined(parts);
}

/// A measured value of the fit, as predictions are: without offset and scale where true values are predicted.
struct DrawnDatum {
  double x, value, deviation;
  std::string label;
};

std::vector<DrawnDatum> drawn_data(const FitRecord& fit, const FitPredictions& predictions, const std::string& along) {
  const Instrument instrument = predictions.as == PredictedAs::true_value
                                    ? instrument_of(fit, predictions.asked.scenes.front().scene.set)
                                    : Instrument{};
  const double scatter = fit.deviations_known ? 1 : std::sqrt(fit.reduced_chi_squared);
  std::map<std::int64_t, std::string> labels;
  for (const FitCurveRecord& point : fit.curves) labels[point.curve] = point.label;
  std::vector<DrawnDatum> data;
  for (std::size_t i = 0; i < fit.data.size(); ++i) {
    const FitDataRecord& one = fit.data[i];
    if (one.curve < 0) continue;  // of another output, or known before
    double x = missing;
    const bool same = fit.x_name == in_words(along);
    if (same) x = one.x;
    for (const FitInputRecord& input : fit.inputs)
      if (!same && input.datum == static_cast<std::int64_t>(i + 1) && input.name == along) x = input.value;
    if (std::isfinite(x))
      data.push_back({x, (one.measured - instrument.offset) / instrument.scale,
                      scatter * one.deviation / instrument.scale, same ? labels[one.curve] : std::string()});
  }
  return data;
}

}  // namespace

std::size_t FitPredictions::without_answer() const {
  return static_cast<std::size_t>(count_if(values, [](const auto& one) { return !std::isfinite(one.value); }));
}

FitPredictions predictions_of(const FitRecord& fit, const std::filesystem::path& scenes, PredictedAs as,
                              const std::string& set, const Evaluate& evaluate, int jobs) {
  FitPredictions answer{as, predicted_scenes(fit, scenes, set), {}};
  answer.values = predicted(fit, answer.asked.output, answer.asked.scenes, as, evaluate, jobs);
  return answer;
}

std::string prediction_summary(const FitRecord& fit, const FitPredictions& predictions) {
  const std::string unit = unit_of_all(predictions);
  Table table{predictions.asked.inputs, {}};
  table.columns.insert(table.columns.end(), {predictions.asked.output, "+-", "95 %"});
  const std::vector<AskedScene>& asked = predictions.asked.scenes;
  const bool measured = any_of(asked, [](const AskedScene& one) { return std::isfinite(one.measured); });
  if (measured) table.columns.emplace_back("measured");
  for (std::size_t i = 0; i < asked.size(); ++i) {
    std::vector<Cell>& row = table.rows.emplace_back();
    for (const std::string& key : predictions.asked.inputs) {
      const Quantity& quantity = find_input(key)->quantity;
      row.emplace_back(
          readable(quantity, input_at(predictions, i, key), quantity.unit_for(body_of(asked[i].scene.scene))));
    }
    const PredictedScene& one = predictions.values[i];
    const ValueAndError shown = value_and_error(one.value, one.standard_error, unit);
    row.emplace_back(shown.value);
    row.emplace_back(shown.error);
    row.emplace_back(std::isfinite(one.value) ? readable(one.lowest, unit) + " .. " + readable(one.highest, unit)
                                              : std::string("no answer"));
    if (measured) row.emplace_back(readable(asked[i].measured, unit));
  }
  std::ostringstream text;
  text << "\npredicted by " << fit.name << ": " << as_in_words(fit, predictions.as) << '\n';
  write_aligned(text, table);
  return text.str();
}

Json json_of(const FitPredictions& predictions) {
  Json list = Json::array();
  for (std::size_t i = 0; i < predictions.values.size(); ++i) {
    const AskedScene& asked = predictions.asked.scenes[i];
    const PredictedScene& one = predictions.values[i];
    Json& object = list.emplace_back(Json{{"place", asked.scene.measured.place}, {"data", asked.scene.set}});
    for (const std::string& key : predictions.asked.inputs)
      object[key] = json_of(cell_of(input_at(predictions, i, key)));
    object.update(json_object("output", predictions.asked.output, "unit", unit_of_all(predictions), "predicted_as",
                              name_of(predictions.as), "value", one.value, "standard_error", one.standard_error,
                              "lowest", one.lowest, "highest", one.highest, "measured", asked.measured));
  }
  return list;
}

ChartRequest prediction_chart(const FitRecord& fit, const FitPredictions& predictions) {
  const std::string along = along_of(predictions);
  const Quantity& x = find_input(along)->quantity;
  const Quantity y = measured_quantity(predictions.asked.output);
  const std::vector<DrawnDatum> data = drawn_data(fit, predictions, along);
  double widest_x = 0, widest_y = 0, least_x = std::numeric_limits<double>::infinity(), least_y = least_x;
  const auto include = [&](double at, double value) {
    widest_x = std::max(widest_x, std::abs(at));
    least_x = std::min(least_x, at);
    if (std::isfinite(value)) widest_y = std::max(widest_y, std::abs(value)), least_y = std::min(least_y, value);
  };
  for (const DrawnDatum& one : data) include(one.x, one.value);
  for (std::size_t i = 0; i < predictions.values.size(); ++i)
    include(input_at(predictions, i, along), predictions.values[i].value);
  const bool warmth = is_temperature(along);
  const ScaledUnit x_unit =
      warmth ? celsius() : scaled_unit(std::string(x.unit_for(body_of_all(predictions))), widest_x);
  const ScaledUnit y_unit = scaled_unit(unit_of_all(predictions), widest_y);
  constexpr double wide = 20;
  ChartRequest request{.title = fit.name + ": predictions, " + as_in_words(fit, predictions.as),
                       .x = {.name = in_words(along),
                             .symbol = std::string(symbol_beside_name(x)),
                             .unit = typeset_unit(x_unit.name),
                             .logarithmic = !warmth && least_x > 0 && widest_x > wide * least_x,
                             .margin = 0.03},
                       .y = {.name = in_words(y.key),
                             .symbol = std::string(y.symbol),
                             .unit = typeset_unit(y_unit.name),
                             .logarithmic = least_y > 0 && widest_y > wide * least_y},
                       .curves = {},
                       .mark_peaks = false};
  request.areas = "deviation of the data, 95 % of the predictions";
  const auto curve_of = [&](const std::string& label, bool line) -> ChartCurve& {
    for (ChartCurve& curve : request.curves)
      if (curve.label == label) return curve;
    request.curves.push_back({.label = label, .points = {}, .line = line});
    return request.curves.back();
  };
  for (std::size_t i = 0; i < predictions.values.size(); ++i) {
    const PredictedScene& one = predictions.values[i];
    const std::string label = label_at(predictions, i, along);
    curve_of(label.empty() ? "predicted" : "predicted, " + label, true)
        .points.push_back({x_unit.number(input_at(predictions, i, along)), y_unit.number(one.value), true,
                           y_unit.number(one.lowest), y_unit.number(one.highest)});
  }
  for (ChartCurve& curve : request.curves)
    stable_sort(curve.points, [](const auto& a, const auto& b) { return a.x < b.x; });
  for (const DrawnDatum& one : data) {
    ChartCurve& curve = curve_of(one.label.empty() ? "measured" : "measured, " + one.label, false);
    curve.points.push_back({x_unit.number(one.x), y_unit.number(one.value), true,
                            y_unit.number(one.value - one.deviation), y_unit.number(one.value + one.deviation)});
    curve.points.push_back({missing, missing});
  }
  return request;
}

}  // namespace rollres
