#include "studies/study.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "core/solution.hpp"
#include "studies/scene_entries.hpp"
#include "studies/study_scene.hpp"

namespace rollres {

namespace {

constexpr double most_points = 1e6;  // more would not fit a study's purpose, nor memory

/// An axis as it was given: the inputs of a list, or the two ends of an interval.
struct GivenAxis {
  std::string key;
  std::string place;
  std::vector<SceneEntry> values = {};
  int points = 0;  ///< of an interval; 0 for a list
  bool logarithmic = false;

  bool choice() const { return !find_input(key)->choices.empty(); }
};

GivenAxis interval(const std::string& key, const Json& object, const std::string& place) {
  constexpr std::string_view known[] = {"from", "to", "points", "spacing"};
  constexpr std::string_view spacings[] = {"linear", "logarithmic"};
  refuse_unknown_keys(object, known, place);
  GivenAxis axis{.key = key, .place = place};
  for (const char* const end : {"from", "to"})
    axis.values.push_back({key, needed(object, end, place, "an interval has from, to and points"), place + ": " + end});
  const Json& count = needed(object, "points", place, "an interval has from, to and points");
  if (!count.is_number_integer() || count < 2 || count > static_cast<int>(most_points))
    refuse(place, "points", count, "must be a whole number from 2 to 1000000");
  axis.points = count.get<int>();
  if (const auto found = object.find("spacing"); found != object.end()) {
    const std::string name = found->is_string() ? found->get<std::string>() : "";
    if (find_name(spacings, name) < 0) refuse(place, "spacing", *found, "must be one of linear, logarithmic");
    axis.logarithmic = name == "logarithmic";
  }
  if (axis.choice()) refuse(place, key, object, "must be a list of names");
  return axis;
}

GivenAxis given_axis(const std::string& key, const Json& value, const std::string& study_place) {
  if (!find_input(key)) refuse(study_place + ": axes", key, value, unknown("unknown key", input_keys(), key));
  const std::string place = study_place + ": axes: " + key;
  if (value.is_object()) return interval(key, value, place);
  if (!value.is_array() || value.empty())
    refuse(study_place + ": axes", key, value, "must be a list of values, or an object with from, to and points");
  GivenAxis axis{.key = key, .place = place};
  for (const Json& item : value) axis.values.push_back({key, item, study_place + ": axes"});
  return axis;
}

std::vector<double> spaced(const GivenAxis& axis, double from, double to) {
  const Json& last = axis.values.back().value;
  if (!std::isfinite(from) || !std::isfinite(to)) refuse(axis.place, "to", last, "the ends must be finite");
  if (from == to) refuse(axis.place, "to", last, "must differ from \"from\"");
  if (axis.logarithmic && (from <= 0 || to <= 0)) refuse(axis.place, "to", last, "logarithmic: both ends must be > 0");
  std::vector<double> values(static_cast<std::size_t>(axis.points));
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(values.size() - 1);
    values[i] = axis.logarithmic ? from * std::pow(to / from, part) : from + (to - from) * part;
  }
  values.back() = to;
  return values;
}

Axis axis_for(const GivenAxis& given, Indenter indenter) {
  Axis axis{.key = given.key, .logarithmic = given.logarithmic};
  for (const SceneEntry& entry : given.values) {
    const InputValue value = input_value(entry, indenter);
    if (const auto* const name = std::get_if<std::string>(&value)) {
      if (std::count(axis.texts.begin(), axis.texts.end(), *name))
        refuse(entry.place, given.key, entry.value, "value given twice");
      axis.texts.push_back(*name);
    } else {
      const double number = std::get<double>(value);
      if (given.points == 0 && std::count(axis.values.begin(), axis.values.end(), number))
        refuse(entry.place, given.key, entry.value, "value given twice");
      axis.values.push_back(number);
    }
  }
  if (given.points > 0) axis.values = spaced(given, axis.values.front(), axis.values.back());
  if (find_input(given.key)->whole)
    for (const double value : axis.values)
      if (value != std::floor(value)) refuse(given.place, given.key, value, "must be a whole number; give a list");
  return axis;
}

InputValue value_of(const Axis& axis, std::size_t index) {
  if (axis.texts.empty()) return axis.values[index];
  return axis.texts[index];
}

/// Calls `visit` with the indices of every combination, the last one varying fastest.
template <class Visit>
void for_each_combination(const std::vector<std::size_t>& sizes, Visit&& visit) {
  if (std::find(sizes.begin(), sizes.end(), 0U) != sizes.end()) return;
  std::vector<std::size_t> at(sizes.size(), 0);
  while (true) {
    visit(at);
    std::size_t position = sizes.size();
    while (position > 0 && ++at[position - 1] == sizes[position - 1]) at[--position] = 0;
    if (position == 0) return;
  }
}

void refuse_axes_that_exclude_each_other(const std::vector<GivenAxis>& axes, const Json& object,
                                         const std::string& place) {
  double count = 1;
  for (const GivenAxis& axis : axes) {
    count *= axis.points > 0 ? axis.points : static_cast<double>(axis.values.size());
    if (find_input(axis.key)->choices.empty())
      for (const std::string_view replaced : replaced_inputs(axis.key, 0.0))
        for (const GivenAxis& other : axes)
          if (other.key == replaced)
            refuse(place + ": axes", axis.key, object[axis.key], "cannot be an axis together with " + other.key);
  }
  if (count > most_points) throw std::invalid_argument(place + ": axes: more than 1000000 points");
}

/// The base scene for every combination of the axes that are choices, numbers at their first value: units and what a
/// scene needs may depend on the choices. Returns the first, with the inputs that only other choices (of a drive) use.
RollingScene base_scene(const std::vector<SceneEntry>& entries, const std::vector<GivenAxis>& axes,
                        const std::string& place) {
  std::vector<std::size_t> sizes;
  for (const GivenAxis& axis : axes) sizes.push_back(axis.choice() ? axis.values.size() : 1);
  std::optional<RollingScene> first;
  std::vector<SceneEntry> of_any;
  for_each_combination(sizes, [&](const std::vector<std::size_t>& at) {
    std::vector<SceneEntry> chosen;
    for (std::size_t i = 0; i < axes.size(); ++i) chosen.push_back(axes[i].values[at[i]]);
    const std::vector<SceneEntry> all = overridden(entries, chosen);
    const RollingScene scene = scene_from(all, place);
    if (!first) first = scene;
    for (const SceneEntry& entry : all)
      if (find_input(entry.key)->optional) of_any.push_back(entry);
  });
  for (const SceneEntry& entry : of_any) assign_input(*first, entry.key, input_value(entry, first->indenter));
  return *first;
}

void refuse_set_axes(const std::vector<SceneEntry>& set, const std::vector<GivenAxis>& axes) {
  for (const SceneEntry& entry : set)
    for (const GivenAxis& axis : axes)
      if (axis.key == entry.key) refuse(entry.place, entry.key, entry.value, "is an axis of the study too");
}

StudyChart study_chart(const Json& study, const std::vector<Axis>& axes, const std::string& place) {
  StudyChart chart;
  const auto found = study.find("chart");
  if (found == study.end()) return chart;
  if (!found->is_object()) refuse(place, "chart", *found, "must be an object with x, y and family");
  constexpr std::string_view known[] = {"x", "y", "family"};
  const std::string chart_place = place + ": chart";
  refuse_unknown_keys(*found, known, chart_place);
  std::vector<std::string_view> axis_keys, numbers;
  for (const Axis& axis : axes) axis_keys.push_back(axis.key);
  const RollingSolution solution;
  visit_outputs(solution, [&](const Quantity& quantity, const auto& value) {
    if constexpr (std::is_arithmetic_v<std::decay_t<decltype(value)>>) numbers.push_back(quantity.key);
  });
  std::vector<std::string_view> either = axis_keys;
  either.insert(either.end(), numbers.begin(), numbers.end());
  auto read = [&](const std::string& key, std::span<const std::string_view> names, const std::string& rule) {
    const auto value = found->find(key);
    if (value == found->end()) return std::string();
    if (!value->is_string()) refuse(chart_place, key, *value, rule);
    const auto name = value->get<std::string>();
    if (find_name(names, name) < 0) refuse(chart_place, key, *value, unknown(rule, names, name));
    return name;
  };
  chart.x = read("x", either, "must be an axis of the study or a number of the solution");
  chart.y = read("y", numbers, "must be a number of the solution");
  chart.family = read("family", axis_keys, "must be an axis of the study");
  if (!chart.family.empty() && chart.family == chart.x)
    refuse(chart_place, "family", chart.family, "must differ from x");
  return chart;
}

}  // namespace

Study read_study(const std::filesystem::path& file) {
  const std::string place = file.string();
  const Json object = read_object(place);
  constexpr std::string_view known[] = {"study", "scene", "set", "axes", "chart", "comment"};
  refuse_unknown_keys(object, known, place);
  if (const auto comment = object.find("comment"); comment != object.end() && !comment->is_string())
    refuse(place, "comment", *comment, "must be a text");

  Study study;
  study.name = needed_text(object, "study", place, "must be the name of the study");
  study.source = place;
  const Json& axes = needed(object, "axes", place, "must be an object with at least one input");
  if (!axes.is_object() || axes.empty()) refuse(place, "axes", axes, "must be an object with at least one input");
  std::vector<GivenAxis> given;
  for (const auto& [key, value] : axes.items()) given.push_back(given_axis(key, value, place));
  refuse_axes_that_exclude_each_other(given, axes, place);

  const std::vector<SceneEntry> set = set_entries(object, place);
  refuse_set_axes(set, given);
  const auto entries = overridden(scene_entries_of(object, file, place), set);
  study.base = base_scene(entries, given, place);
  std::vector<Indenter> indenters{study.base.indenter};
  for (const GivenAxis& axis : given)
    if (axis.key == "indenter") indenters = {Indenter::cylinder, Indenter::sphere};
  for (const GivenAxis& axis : given) {
    for (const Indenter indenter : indenters) axis_for(axis, indenter);
    study.axes.push_back(axis_for(axis, study.base.indenter));
  }
  study.chart = study_chart(object, study.axes, place);
  points(study);
  return study;
}

std::vector<RollingScene> points(const Study& study) {
  std::vector<std::size_t> sizes;
  for (const Axis& axis : study.axes) sizes.push_back(axis.size());
  std::vector<RollingScene> scenes;
  for_each_combination(sizes, [&](const std::vector<std::size_t>& at) {
    RollingScene scene = study.base;
    std::string where = study.source.empty() ? study.name : study.source;
    for (std::size_t i = 0; i < at.size(); ++i) {
      const InputValue value = value_of(study.axes[i], at[i]);
      where += (i == 0 ? ": axes at " : ", ") + study.axes[i].key + " = " + text_of(value);
      set_input(scene, study.axes[i].key, value);
    }
    if (const auto broken = check(scene); !broken.empty()) throw std::invalid_argument(where + ": " + broken.front());
    scenes.push_back(scene);
  });
  return scenes;
}

}  // namespace rollres
