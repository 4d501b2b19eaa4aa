#include "studies/study/study_axes.hpp"

#include <cmath>
#include <set>
#include <stdexcept>

#include "core/scene/scene_input.hpp"
#include "studies/scene_io/usual_names.hpp"
#include "studies/study/sampling.hpp"
#include "studies/study/study_keys.hpp"
#include "studies/study/study_variants.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

namespace {

int number_of_points(const Json& object, int least, const std::string& place, const std::string& rule) {
  return whole_number(needed(object, "points", place, rule), "points", least, most_points, place);
}

/// An axis between two ends, its positions still to be filled.
GivenAxis between(const std::string& key, const Json& object, const std::string& place, const std::string& rule) {
  GivenAxis axis{.key = held_key(key), .place = place, .shown = object, .values = {}};
  if (axis.choice()) refuse(place, key, object, "must be a list of names");
  for (const char* const end : {"from", "to"})
    axis.values.push_back(held_entry({key, needed(object, end, place, rule), place + ": " + end}));
  axis.logarithmic = name_or_first(object, "spacing", spacing_names, place) == "logarithmic";
  return axis;
}

GivenAxis interval(const std::string& key, const Json& object, const std::string& place) {
  refuse_unknown_keys(object, interval_keys, place);
  const std::string rule = "an interval has from, to and points";
  GivenAxis axis = between(key, object, place, rule);
  const int points = number_of_points(object, 2, place, rule);
  for (int i = 0; i < points; ++i) axis.positions.push_back(i / (points - 1.0));
  return axis;
}

/// A list or an interval of one input.
GivenAxis single_axis(const std::string& key, const Json& value, const std::string& place) {
  if (is_of_variants(key))
    refuse(place, key, value, "cannot be zipped; what goes together with it belongs into the variants");
  if (!find_input(key)) refuse(place, key, value, unknown_input(keys_like(key), key));
  if (find_input(key)->list) refuse(place, key, value, "a list cannot vary by itself; give each list in a variant");
  if (value.is_object()) return interval(key, value, place + ": " + key);
  if (value.is_array() && value.empty()) refuse(place, key, value, "has no value: leave the axis out, or give it one");
  if (!value.is_array()) refuse(place, key, value, "must be a list of values, or an object with from, to and points");
  GivenAxis axis{.key = held_key(key), .place = place + ": " + key, .shown = value, .values = {}};
  for (const Json& item : value) axis.values.push_back(held_entry({key, item, place}));
  return axis;
}

std::vector<GivenAxis> zip(const std::string& name, const Json& object, const std::string& axes_place) {
  const std::string place = axes_place + ": " + name;
  if (find_input(name) || name == sample_group || name == uncertain_group || name.empty())
    refuse(place, "zip", object["zip"], "the name of a zip must not be that of an input, \"sample\" or \"uncertain\"");
  refuse_unknown_keys(object, zip_keys, place);
  const Json& inputs = object["zip"];
  const bool alone = !object.contains("columns");
  if (!inputs.is_object() || inputs.size() < (alone ? 2 : 1))
    refuse(place, "zip", inputs,
           alone ? "must be an object of two or more inputs, or of one with columns beside it"
                 : "must be an object with at least one input");
  std::vector<GivenAxis> axes;
  for (const auto& [key, value] : inputs.items()) {
    axes.push_back(single_axis(key, value, place + ": zip"));
    axes.back().group = name;
    if (axes.back().size() != axes.front().size())
      refuse(place + ": zip", key, value,
             "has " + std::to_string(axes.back().size()) + " values, but " + axes.front().key + " has " +
                 std::to_string(axes.front().size()));
  }
  return axes;
}

std::vector<GivenAxis> sample(const Json& object, const std::string& place) {
  if (!object.is_object()) throw std::invalid_argument(place + ": must be an object with method, points and ranges");
  refuse_unknown_keys(object, sample_keys, place);
  constexpr auto& methods = ChoiceNames<SampleMethod>::names;
  const std::string method = needed_name(object, "method", methods, place, "must be one of sobol, latin_hypercube");
  const int points = number_of_points(object, 1, place, "a sample has method, points and ranges");
  std::uint64_t seed = 0;
  if (const auto found = object.find("seed"); found != object.end()) {
    if (!found->is_number_unsigned()) refuse(place, "seed", *found, "must be a whole number >= 0");
    seed = found->get<std::uint64_t>();
  }
  const std::string rule = "must be an object with at least one input";
  const Json& ranges = needed(object, "ranges", place, rule);
  if (!ranges.is_object() || ranges.empty()) refuse(place, "ranges", ranges, rule);
  std::vector<GivenAxis> axes;
  for (const auto& [key, range] : ranges.items()) {
    const InputKind* const input = find_input(key);
    const std::string ranges_place = place + ": ranges";
    if (!input) refuse(ranges_place, key, range, unknown_input(keys_like(key), key));
    if (!input->real()) refuse(ranges_place, key, range, "must be an input that is a real number; make it an axis");
    if (!range.is_object()) refuse(ranges_place, key, range, "must be an object with from and to");
    refuse_unknown_keys(range, range_keys, ranges_place + ": " + key);
    axes.push_back(between(key, range, ranges_place + ": " + key, "a range has from and to"));
    axes.back().group = sample_group;
  }
  const auto columns = unit_sample(static_cast<SampleMethod>(find_name(methods, method)),
                                   static_cast<std::size_t>(points), axes.size(), seed);
  for (std::size_t i = 0; i < axes.size(); ++i) axes[i].positions = columns[i];
  return axes;
}

void refuse_axes_that_exclude_each_other(const std::vector<GivenAxis>& axes) {
  for (const GivenAxis& axis : axes) {
    const std::size_t end = axis.place.rfind(": ");
    const std::string outer = axis.place.substr(0, end);
    const auto written = [](const GivenAxis& one) { return one.place.substr(one.place.rfind(": ") + 2); };
    for (const GivenAxis& other : axes)
      if (&other < &axis && other.key == axis.key)
        refuse(outer, written(axis), axis.shown,
               (written(other) == written(axis) ? "" : written(other) + ", the same input, ") + "varies already");
    if (axis.choice()) continue;
    for (const std::string_view replaced : replaced_inputs(axis.key, 0.0))
      for (const GivenAxis& other : axes)
        if (other.key == replaced) refuse(outer, axis.key, axis.shown, "cannot be an axis together with " + other.key);
  }
}

std::vector<double> spaced(const GivenAxis& axis, double from, double to) {
  const Json& last = axis.values.back().value;
  if (!std::isfinite(from) || !std::isfinite(to)) refuse(axis.place, "to", last, "the ends must be finite");
  if (from == to) refuse(axis.place, "to", last, "must differ from \"from\"");
  if (axis.logarithmic && (from <= 0 || to <= 0)) refuse(axis.place, "to", last, "logarithmic: both ends must be > 0");
  std::vector<double> values;
  for (const double at : axis.positions) values.push_back(spaced_value(from, to, at, axis.logarithmic));
  return values;
}

/// The body that goes with a value of an axis, or the bodies.
std::vector<Body> bodies_at(const std::vector<GivenAxis>& axes, const GivenAxis& axis, std::size_t index, Body usual) {
  auto body = [&](const SceneEntry& entry) -> Body {
    return static_cast<Indenter>(
        find_name(ChoiceNames<Indenter>::names, std::get<std::string>(input_value(entry, usual))));
  };
  for (const GivenAxis& other : axes) {
    if (other.key != "indenter") continue;
    const bool row_by_row = !axis.group.empty() && other.group == axis.group && axis.positions.empty();
    if (row_by_row) return {body(other.values[index])};
    std::vector<Body> bodies;
    for (const SceneEntry& entry : other.values) bodies.push_back(body(entry));
    return bodies;
  }
  return {usual};
}

Axis axis_of(const std::vector<GivenAxis>& all, const GivenAxis& given, Body usual) {
  Axis axis{.key = given.key, .logarithmic = given.logarithmic, .group = given.group};
  for (std::size_t i = 0; i < given.values.size(); ++i) {
    const SceneEntry& entry = given.values[i];
    InputValue value;
    for (const Body body : bodies_at(all, given, i, usual)) value = input_value(entry, body);
    if (const auto* const name = std::get_if<std::string>(&value))
      axis.texts.push_back(*name);
    else
      axis.values.push_back(std::get<double>(value));
  }
  if (!given.positions.empty()) axis.values = spaced(given, axis.values.front(), axis.values.back());
  if (find_input(given.key)->whole)
    for (const double value : axis.values)
      if (value != std::floor(value)) refuse(given.place, given.key, value, "must be a whole number; give a list");
  return axis;
}

/// The same value, or the same values of what varies together, would be the same point again.
void refuse_repeated_values(const std::vector<GivenAxis>& given, const std::vector<Axis>& axes) {
  for (const auto& group : groups_of(axes)) {
    if (!given[group.front()].positions.empty() || axes[group.front()].group == uncertain_group) continue;
    std::set<std::vector<std::string>> seen;
    for (std::size_t i = 0; i < axes[group.front()].size(); ++i) {
      std::vector<std::string> values;
      for (const std::size_t axis : group)
        values.push_back(axes[axis].texts.empty() ? text_of(axes[axis].values[i]) : axes[axis].texts[i]);
      if (seen.insert(values).second) continue;
      const SceneEntry& first = given[group.front()].values[i];
      refuse(first.place, first.key, first.value,
             group.size() == 1 ? "value given twice"
                               : "given twice with the same values of the inputs that vary together with it");
    }
  }
}

}  // namespace

double spaced_value(double from, double to, double share, bool logarithmic) {
  return share == 1 ? to : logarithmic ? from * std::pow(to / from, share) : from + (to - from) * share;
}

std::vector<GivenAxis> given_axes(const Json& study, const std::string& place, std::size_t variants,
                                  const std::vector<GivenAxis>& uncertain) {
  const auto axes = study.find("axes"), box = study.find("sample");
  if (axes == study.end() && box == study.end() && !study.contains("uncertain"))
    throw std::invalid_argument(place + ": axes is missing: a study needs axes, a sample or uncertain inputs");
  std::vector<GivenAxis> given;
  if (axes != study.end()) {
    if (!axes->is_object() || axes->empty()) refuse(place, "axes", *axes, "must be an object with at least one input");
    for (const auto& [key, value] : axes->items()) {
      if (is_of_variants(key)) continue;
      if (value.is_object() && value.contains("zip"))
        for (GivenAxis& axis : zip(key, value, place + ": axes")) given.push_back(std::move(axis));
      else
        given.push_back(single_axis(key, value, place + ": axes"));
    }
  }
  if (box != study.end())
    for (GivenAxis& axis : sample(*box, place + ": sample")) given.push_back(std::move(axis));
  given.insert(given.end(), uncertain.begin(), uncertain.end());
  refuse_axes_that_exclude_each_other(given);
  double count = static_cast<double>(std::max<std::size_t>(variants, 1));
  for (const auto& group : groups_of(given)) count *= static_cast<double>(given[group.front()].size());
  if (count > most_points)
    throw std::invalid_argument(place + ": axes: make " + short_number(count) + " points, more than " +
                                std::to_string(most_points));
  return given;
}

std::vector<Axis> axes_of(const std::vector<GivenAxis>& given, Body usual) {
  std::vector<Axis> axes;
  for (const GivenAxis& axis : given) axes.push_back(axis_of(given, axis, usual));
  refuse_repeated_values(given, axes);
  return axes;
}

}  // namespace rollres
