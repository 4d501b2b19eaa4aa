#include "studies/study/study_outputs.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <stdexcept>
#include <type_traits>

#include "core/scene/solution.hpp"
#include "db/rows/schema.hpp"
#include "studies/scene_io/dimension.hpp"
#include "studies/scene_io/scene_entries.hpp"
#include "studies/scene_io/scene_inputs.hpp"
#include "studies/study/study_keys.hpp"
#include "studies/text/units.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

/// A name that a formula may have: none that stands for something else.
void refuse_taken_name(const std::string& name, const Json& formula, const FormulaDefinitions& earlier,
                       const std::string& place) {
  constexpr const char* letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789";
  constexpr std::array<std::string_view, 5> columns{"id", "key", "created", "provenance", "note"};
  const bool is_name = !name.empty() && name.find_first_not_of(letters) == std::string::npos &&
                       std::isdigit(static_cast<unsigned char>(name.front())) == 0;
  if (!is_name) refuse(place, name, formula, "a name is of letters, digits and _, and begins with none of the digits");
  const bool given = any_of(earlier, [&](const auto& one) { return one.first == name; });
  if (given) refuse(place, name, formula, "given twice");
  if (find_quantity_column(name) || (find_input(name) && held_key(name) == name) || find_name(columns, name) >= 0 ||
      find_name(point_columns, name) >= 0)
    refuse(place, name, formula, "names a column that is there already; give the formula another name");
  if (is_function(name)) refuse(place, name, formula, "names a function or a number; give the formula another name");
}

/// Reads one formula, with those before it in full.
void add_formula(ComputeWish& wish, const std::string& name, const Json& formula, std::span<const Body> bodies,
                 const std::string& place) {
  refuse_taken_name(name, formula, wish.formulas, place);
  if (!formula.is_string()) refuse(place, name, formula, "must be a formula of inputs and outputs");
  const std::string text = with_definitions(formula.get<std::string>(), wish.formulas);
  refusing_at(place + ": " + name, [&] {
    const Formula understood(text, FormulaNames::inputs_and_outputs);
    for (const Body body : bodies) refuse_different_units(understood, body);
  });
  wish.columns.push_back(name);
  wish.formulas.emplace_back(name, text);
}

/// "(load > 4999.99 && load < 5000.01)" for what is zipped, an entry for each input, or empty where all are names.
std::string stands_at(const std::vector<SceneEntry>& inputs, Body body) {
  std::string text;
  for (const SceneEntry& input : inputs) {
    const InputValue given = input_value(input, body);
    const double* const value = std::get_if<double>(&given);
    if (!value || !std::isfinite(*value)) continue;
    constexpr double apart = 1e-6;  // an output, such as the load, meets its input to less
    const double size = *value == 0 ? apart : apart * std::abs(*value);
    text += (text.empty() ? "(" : " && ") + input.key + " > " + shortest(*value - size) + " && " + input.key + " < " +
            shortest(*value + size);
  }
  return text.empty() ? text : text + ")";
}

/// A column beside a zip as a formula.
std::string formula_of_column(const std::string& name, const Json& numbers, const Json& inputs, Body body,
                              const std::string& place) {
  if (!numbers.is_array() || numbers.empty() || !all_of(numbers, [](const Json& one) { return one.is_number(); }))
    refuse(place, name, numbers, "must be a list of numbers");
  std::vector<std::string> places;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    std::vector<SceneEntry> entries;
    for (const auto& [key, values] : inputs.items()) {
      if (!values.is_array()) refuse(place, name, numbers, "needs lists of values in the zip, not an interval");
      if (values.size() != numbers.size())
        refuse(
            place, name, numbers,
            "has " + std::to_string(numbers.size()) + " values, but " + key + " has " + std::to_string(values.size()));
      entries.push_back(held_entry({key, values[i], place}));
    }
    places.push_back(stands_at(entries, body));
    if (places.back().empty() || std::count(places.begin(), places.end(), places.back()) > 1)
      refuse(place, name, numbers,
             "the zip's values number " + std::to_string(i + 1) + " are not told from others by numbers");
  }
  std::string text = shortest(numbers.back().get<double>());
  for (std::size_t i = numbers.size() - 1; i-- > 0;)
    text = places[i] + " ? " + shortest(numbers[i].get<double>()) + " : (" + text + ")";
  return text;
}

/// Reads the columns of a study's zips. @param bodies  at least one, the first for the zips' units
void add_columns_of_zips(ComputeWish& wish, const Json& study, std::span<const Body> bodies, const std::string& place) {
  const auto axes = study.find("axes");
  if (axes == study.end() || !axes->is_object()) return;
  for (const auto& [group, axis] : axes->items()) {
    if (!axis.is_object() || !axis.contains("columns") || !axis.contains("zip") || !axis["zip"].is_object()) continue;
    const std::string here = place + ": axes: " + group + ": columns";
    if (!axis["columns"].is_object() || axis["columns"].empty())
      refuse(place + ": axes: " + group, "columns", axis["columns"], "must be an object of names and lists of numbers");
    for (const auto& [name, numbers] : axis["columns"].items()) {
      refuse_taken_name(name, numbers, wish.formulas, here);
      add_formula(wish, name, formula_of_column(name, numbers, axis["zip"], bodies.front(), here), bodies, here);
    }
  }
}

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

/// @param numbers  that it may show
StudyChart study_chart(const Json& object, const std::vector<std::string_view>& axes,
                       const std::vector<std::string_view>& numbers, const std::string& place) {
  refuse_unknown_keys(object, chart_keys, place);
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

std::vector<Condition> study_constraints(const Json& study, std::span<const Body> bodies,
                                         const FormulaDefinitions& formulas, const std::string& place) {
  std::vector<Condition> conditions;
  for (const std::string& text : texts(study, "constraints", place, "must be a list of conditions between inputs"))
    refusing_at(place + ": constraint " + std::to_string(conditions.size() + 1), [&] {
      for (const Body body : bodies) Condition(text, FormulaNames::inputs, body, formulas);
      conditions.emplace_back(text, FormulaNames::inputs, bodies.front(), formulas);
    });
  return conditions;
}

ComputeWish compute_wish(const Json& study, std::span<const Body> bodies, const std::string& place) {
  ComputeWish wish;
  add_columns_of_zips(wish, study, bodies, place);
  const auto found = study.find("compute");
  if (found == study.end()) {
    wish.columns.clear();
    return wish;
  }
  const std::string rule = "must be a list of outputs and of objects {name: formula}, or such an object";
  const Json list = found->is_object() ? Json::array({*found}) : *found;
  if (!list.is_array() || list.empty() || list.front().empty()) refuse(place, "compute", *found, rule);
  for (const Json& item : list) {
    if (item.is_object()) {
      for (const auto& [name, formula] : item.items()) add_formula(wish, name, formula, bodies, place + ": compute");
      continue;
    }
    if (!item.is_string()) refuse(place, "compute", item, rule);
    const auto& output = item.get_ref<const std::string&>();
    if (find_name(output_keys(), output) < 0)
      refuse(place, "compute", item, unknown("unknown output", output_keys(), output, "a formula is {name: formula}"));
    if (std::count(wish.columns.begin(), wish.columns.end(), output) > 0) refuse(place, "compute", item, "given twice");
    wish.columns.push_back(output);
  }
  return wish;
}

ComputeWish accepted_compute_wish(const Json& study) {
  ComputeWish wish;
  for (const Body body : {Body(Indenter::cylinder), Body(Indenter::cylinder, true), Body(Indenter::sphere)}) try {
      add_columns_of_zips(wish, study, {&body, 1}, "axes");
      break;
    } catch (const std::invalid_argument&) {  // units of another body, or columns of another version
      wish = {};
    }
  const auto found = study.find("compute");
  if (found == study.end()) {
    wish.columns.clear();
    return wish;
  }
  const Json list = found->is_object() ? Json::array({*found}) : *found;
  for (const Json& item : list)
    if (item.is_string()) {
      wish.columns.push_back(item.get<std::string>());
    } else if (item.is_object()) {
      for (const auto& [name, formula] : item.items()) try {
          add_formula(wish, name, formula, {}, "compute");
        } catch (const std::invalid_argument&) {  // of another version
        }
    }
  return wish;
}

std::vector<StudyChart> study_charts(const Json& study, const std::vector<Axis>& axes,
                                     const FormulaDefinitions& formulas, const std::string& place) {
  std::vector<std::string_view> keys, numbers = number_outputs();
  for (const Axis& axis : axes) keys.push_back(axis.key);
  for (const auto& [name, formula] : formulas) numbers.push_back(name);
  const auto one = study.find("chart"), several = study.find("charts");
  if (one != study.end() && several != study.end()) refuse(place, "charts", *several, "give chart or charts, not both");
  if (one != study.end()) {
    if (!one->is_object()) refuse(place, "chart", *one, "must be an object with x, y and family");
    return {study_chart(*one, keys, numbers, place + ": chart")};
  }
  std::vector<StudyChart> charts;
  if (several == study.end()) return charts;
  const std::string rule = "must be a list of objects with name, x, y and family";
  if (!several->is_array() || several->empty()) refuse(place, "charts", *several, rule);
  for (const Json& object : *several) {
    if (!object.is_object()) refuse(place, "charts", object, rule);
    const std::string chart_place = place + ": charts: " + std::to_string(charts.size() + 1);
    const StudyChart chart = study_chart(object, keys, numbers, chart_place);
    for (const StudyChart& other : charts)
      if (!chart.name.empty() && chart.name == other.name) refuse(chart_place, "name", chart.name, "name given twice");
    charts.push_back(chart);
  }
  return charts;
}

}  // namespace rollres
