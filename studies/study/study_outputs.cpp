#include "studies/study/study_outputs.hpp"

#include <algorithm>
#include <type_traits>

#include "core/scene/solution.hpp"
#include "studies/study/study_keys.hpp"
#include "studies/text/units.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

/// The list of texts under a key; nothing if there is no such key.
std::vector<std::string> texts(const Json& study, const std::string& key, const std::string& place,
                               const std::string& rule) {
  const auto found = study.find(key);
  if (found == study.end()) return {};
  if (!found->is_array() || found->empty()) refuse(place, key, *found, rule);
  std::vector<std::string> list;
  for (const Json& item : *found) {
    if (!item.is_string()) refuse(place, key, item, rule);
    list.push_back(item.get<std::string>());
    if (std::count(list.begin(), list.end(), list.back()) > 1) refuse(place, key, item, "given twice");
  }
  return list;
}

StudyChart study_chart(const Json& object, const std::vector<std::string_view>& axes, const std::string& place) {
  refuse_unknown_keys(object, chart_keys, place);
  const std::vector<std::string_view> numbers = number_outputs();
  std::vector<std::string_view> either = axes;
  either.insert(either.end(), numbers.begin(), numbers.end());
  const auto read = [&](const char* key, std::span<const std::string_view> names, const std::string& rule) {
    return object.contains(key) ? needed_name(object, key, names, place, rule) : std::string();
  };
  StudyChart chart;
  if (object.contains("name")) {
    const std::string rule = "must be a text, but not \"all\" and no number";
    chart.name = needed_name(object, "name", place, rule);
    if (chart.name == "all" || plain_number(chart.name)) refuse(place, "name", chart.name, rule);
  }
  if (object.contains("map")) {
    chart.map = read("map", numbers, "must be a number of the solution");
    chart.x = read("x", axes, "must be an axis of the study");
    chart.y = read("y", axes, "must be an axis of the study");
    if (!chart.y.empty() && chart.y == chart.x) refuse(place, "y", chart.y, "must differ from x");
    if (const auto family = object.find("family"); family != object.end())
      refuse(place, "family", *family, "is for curves, not for a map");
    return chart;
  }
  chart.x = read("x", either, "must be an axis of the study or a number of the solution");
  chart.y = read("y", numbers, "must be a number of the solution");
  chart.family = read("family", axes, "must be an axis of the study");
  if (!chart.family.empty() && chart.family == chart.x) refuse(place, "family", chart.family, "must differ from x");
  return chart;
}

}  // namespace

std::vector<std::string_view> number_outputs() {
  std::vector<std::string_view> keys;
  const RollingSolution solution;
  visit_outputs(solution, [&](const Quantity& quantity, const auto& value) {
    if constexpr (std::is_arithmetic_v<std::decay_t<decltype(value)>>) keys.push_back(quantity.key);
  });
  return keys;
}

std::vector<Condition> study_constraints(const Json& study, std::span<const Indenter> indenters,
                                         const std::string& place) {
  std::vector<Condition> conditions;
  for (const std::string& text : texts(study, "constraints", place, "must be a list of conditions between inputs"))
    refusing_at(place + ": constraints", [&] {
      for (const Indenter indenter : indenters) Condition(text, FormulaNames::inputs, indenter);
      conditions.emplace_back(text, FormulaNames::inputs, indenters.front());
    });
  return conditions;
}

std::vector<std::string> study_outputs(const Json& study, const std::string& place) {
  const std::string rule = "must be a list of outputs";
  const std::vector<std::string> outputs = texts(study, "compute", place, rule);
  for (const std::string& output : outputs)
    if (find_name(output_keys(), output) < 0)
      refuse(place, "compute", output, unknown("unknown output", output_keys(), output));
  return outputs;
}

std::vector<StudyChart> study_charts(const Json& study, const std::vector<Axis>& axes, const std::string& place) {
  std::vector<std::string_view> keys;
  for (const Axis& axis : axes) keys.push_back(axis.key);
  const auto one = study.find("chart"), several = study.find("charts");
  if (one != study.end() && several != study.end()) refuse(place, "charts", *several, "give chart or charts, not both");
  if (one != study.end()) {
    if (!one->is_object()) refuse(place, "chart", *one, "must be an object with x, y and family");
    return {study_chart(*one, keys, place + ": chart")};
  }
  std::vector<StudyChart> charts;
  if (several == study.end()) return charts;
  const std::string rule = "must be a list of objects with name, x, y and family";
  if (!several->is_array() || several->empty()) refuse(place, "charts", *several, rule);
  for (const Json& object : *several) {
    if (!object.is_object()) refuse(place, "charts", object, rule);
    const std::string chart_place = place + ": charts: " + std::to_string(charts.size() + 1);
    const StudyChart chart = study_chart(object, keys, chart_place);
    for (const StudyChart& other : charts)
      if (!chart.name.empty() && chart.name == other.name) refuse(chart_place, "name", chart.name, "name given twice");
    charts.push_back(chart);
  }
  return charts;
}

}  // namespace rollres
