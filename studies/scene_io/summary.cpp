#include "studies/scene_io/summary.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <type_traits>
#include <vector>

#include "core/scene/idle_inputs.hpp"
#include "core/scene/scene_input.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/table_output.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

/// Short lists in full, of longer ones the ends.
std::string list_text(const Quantity& quantity, const std::vector<double>& values, std::string_view unit) {
  const auto text = [&](double value) { return readable(quantity, value, unit); };
  constexpr std::size_t most = 6;
  if (values.size() > most)
    return std::to_string(values.size()) + " values, " + text(values.front()) + " ... " + text(values.back());
  return joined(values, ", ", text);
}

template <class Value>
std::string value_text(const Quantity& quantity, const Value& value, std::string_view unit) {
  if constexpr (std::is_enum_v<Value>)
    return std::string(name_of(value));
  else if constexpr (std::is_same_v<Value, std::optional<double>>)
    return value ? readable(quantity, *value, unit) : "";
  else if constexpr (std::is_floating_point_v<Value>)
    return std::isnan(value) ? "" : readable(quantity, value, unit);
  else if constexpr (std::is_integral_v<Value>)
    return std::to_string(value);
  else if constexpr (std::is_same_v<Value, std::vector<double>>)
    return list_text(quantity, value, unit);
  else
    return "";  // texts stand at the top, layers' inputs one by one
}

/// What inputs are by default.
using UsualTexts = std::map<std::string_view, std::string>;

auto into(UsualTexts& texts) {
  return [&texts](const Quantity& quantity, const auto& value) {
    texts[quantity.key] = value_text(quantity, value, quantity.unit);
  };
}

UsualTexts usual_layer() {
  UsualTexts texts;
  const BondedLayer layer;
  visit_layer_inputs(layer, into(texts));
  return texts;
}

UsualTexts usual_scene() {
  UsualTexts texts;
  const RollingScene scene;
  visit_inputs(scene, into(texts));
  return texts;
}

/// The error of an output, in the unit that this has; empty if it is none, or nothing scales it.
/// @param values  of the outputs before, by their keys
std::string error_text(const std::map<std::string_view, double>& values, std::string_view key, double error,
                       std::string_view unit) {
  constexpr std::string_view ending = "_error";
  if (!key.ends_with(ending) || !std::isfinite(error)) return "";
  const auto value = values.find(key.substr(0, key.size() - ending.size()));
  if (value == values.end() || !std::isfinite(value->second) || value->second == 0) return "";
  const ScaledUnit scaled = scaled_unit(unit, value->second);
  return short_number(scaled.number(error), shown_digits) + (scaled.name.empty() ? "" : " " + scaled.name);
}

std::string headline(const RollingSolution& solution) {
  if (solution.status == Status::converged) return "converged";
  if (solution.status == Status::no_steady_state) return "NO STEADY STATE";
  return "NOT CONVERGED: the numbers below are where the solver stopped, not an answer";
}

}  // namespace

std::string summary(const RollingScene& scene, const RollingSolution& solution) {
  std::string text = "status   " + headline(solution) + '\n';
  if (!solution.reason.empty()) text += "reason   " + solution.reason + '\n';
  for (const std::string& warning : solution.warnings) text += "warning  " + warning + '\n';
  const std::vector<std::string> nameless(3);
  Table inputs{nameless, {}}, outputs{nameless, {}};
  const auto add = [](Table& table, const Quantity& quantity, std::string_view symbol, const std::string& value) {
    if (!value.empty()) table.rows.push_back({std::string(quantity.key), std::string(symbol), value});
  };
  const UsualTexts in_layer = usual_layer(), in_scene = usual_scene();
  std::vector<std::string> unused;
  visit_all_inputs(scene, [&](const Quantity& quantity, const auto& value) {
    const std::string shown = value_text(quantity, value, quantity.unit_for(body_of(scene)));
    const std::optional<LayerKey> layered = layer_key(quantity.key);
    const bool usual = layered && shown == in_layer.at(layered->input);
    if (is_idle(scene, quantity.key)) {
      if (!shown.empty() && !usual && (layered || shown != in_scene.at(quantity.key)))
        unused.push_back(std::string(quantity.key) + " = " + shown);
    } else if (!usual) {
      add(inputs, quantity, symbol_beside_name(quantity), shown);
    }
  });
  if (!unused.empty()) text += "unused   " + joined(unused, ", ") + ": nothing in this scene asks for it\n";
  if (!solution.model.empty()) text += "model    " + solution.model + '\n';
  std::map<std::string_view, double> values;
  visit_outputs(solution, [&](const Quantity& quantity, const auto& value) {
    using Value = std::decay_t<decltype(value)>;
    const std::string_view unit = quantity.unit_for(body_of(scene));
    std::string shown;
    if constexpr (std::is_floating_point_v<Value>) {
      shown = error_text(values, quantity.key, value, unit);
      values[quantity.key] = value;
      if (quantity.key == "rolling_resistance" && std::abs(value) < solution.rolling_resistance_error)
        shown = value_text(quantity, value, unit) + ", less than its error";
    }
    if constexpr (std::is_arithmetic_v<Value> || std::is_same_v<Value, std::vector<double>>)
      add(outputs, quantity, quantity.symbol, shown.empty() ? value_text(quantity, value, unit) : shown);
    if (quantity.key == "model_error" && std::isnan(solution.model_error) && solution.status == Status::converged)
      add(outputs, quantity, quantity.symbol, "not known: --explain tells what the model assumes");
  });
  std::ostringstream tables;
  write_aligned(tables << "\nscene\n", inputs, "", "  ");
  write_aligned(tables << "\nsolution\n", outputs, "", "  ");
  return text + tables.str();
}

std::string explanation(const RollingScene& scene, const RollingSolution& solution) {
  std::string text = "decisions\n  - method " + std::string(name_of(solution.method)) +
                     (scene.method == solution.method ? ", as asked for" : ", chosen for the scene") + '\n';
  for (std::size_t begin = 0; begin < solution.model.size();) {
    const std::size_t end = std::min(solution.model.find("; ", begin), solution.model.size());
    text += "  - " + solution.model.substr(begin, end - begin) + '\n';
    begin = end + 2;
  }
  if (std::isfinite(solution.error_estimate)) {
    text += "  - estimated error of R_r: " + short_number(solution.error_estimate, 2);
    if (scene.tolerance) text += ", wanted " + short_number(*scene.tolerance, 2);
    text += '\n';
  }
  if (solution.assumptions.empty()) return text;
  text += "assumed\n";
  for (const std::string& assumption : solution.assumptions) text += "  - " + assumption + '\n';
  if (std::isfinite(solution.model_error))
    text += "  - together these change R_r by about " + percent(solution.model_error, 2) + '\n';
  return text;
}

}  // namespace rollres
