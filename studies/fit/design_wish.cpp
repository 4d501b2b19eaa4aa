#include "studies/fit/design_wish.hpp"

#include <stdexcept>

#include "core/model/scene_rules.hpp"
#include "core/scene/scene_input.hpp"
#include "studies/fit/fit_keys.hpp"
#include "studies/scene_io/scene_entries.hpp"
#include "studies/scene_io/scene_inputs.hpp"
#include "studies/scene_io/usual_names.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

bool is_fitted(const FitFile& fit, const std::string& key) {
  return any_of(fit.inputs, [&](const FittedInput& input) { return input.input.key == key; });
}

/// A real input of the scene that is not fitted.
const InputKind& free_input(const FitFile& fit, const std::string& key, const Json& value, const std::string& place) {
  const InputKind* const kind = find_input(key);
  if (!kind) refuse(place, key, value, unknown_input(keys_like(key), key));
  if (!kind->real()) refuse(place, key, value, "must be an input that is a number");
  if (is_fitted(fit, held_key(key))) refuse(place, key, value, "is fitted: it has no place here");
  return *kind;
}

DesignRange given_range(const FitFile& fit, const std::string& key, const Json& value, const std::string& place) {
  free_input(fit, key, value, place);
  const std::string inside = place + ": " + key;
  if (!value.is_object()) refuse(place, key, value, "must be an object with from and to");
  refuse_unknown_keys(value, design_range_keys, inside);
  const auto end = [&](const char* name) {
    const Json& given = needed(value, name, inside, "must be the end of a range");
    return std::get<double>(input_value({key, given, inside + ": " + name}, fit.body()));
  };
  const DesignRange range{held_key(key), end("from"), end("to")};
  if (!(range.highest > range.lowest)) refuse(inside, "to", value.at("to"), "must be above from");
  if (!std::isfinite(range.highest)) refuse(inside, "to", value.at("to"), "must be finite");
  return range;
}

MeasuredScene given_target(const FitFile& fit, const Json& value, const std::string& place) {
  std::string set = fit.scenes.front().set;
  if (value.contains("data")) set = needed_text(value, "data", place, "must be the name of a data set");
  const auto first =
      find_if(fit.scenes, [&](const MeasuredScene& row) { return row.set == set && !is_of_material(row.output); });
  if (first == fit.scenes.end()) refuse(place, "data", set, "must be a data set with measured outputs of scenes");
  MeasuredScene target = *first;
  std::string words;
  for (const auto& [key, given] : value.items()) {
    if (key == "data") continue;
    const InputKind& kind = free_input(fit, key, given, place);
    const double number = std::get<double>(input_value({key, given, place}, fit.body()));
    set_input(target.scene, held_key(key), number);
    words +=
        (words.empty() ? " at " : ", ") + held_key(key) + " = " + readable(number, kind.quantity.unit_for(fit.body()));
  }
  if (const auto broken = check(target.scene); !broken.empty())
    throw std::invalid_argument(place + ": " + broken.front());
  target.measured.place = (target.output.empty() ? fit.output : target.output) + words;
  return target;
}

}  // namespace

DesignWish read_design(const Json& object, const FitFile& fit, const std::string& place) {
  const auto found = object.find("design");
  if (found == object.end()) return {};
  if (!found->is_object()) refuse(place, "design", *found, "must be an object { ... }");
  const std::string inside = place + ": design";
  refuse_unknown_keys(*found, design_wish_keys, inside);
  DesignWish wish;
  wish.points = whole_number_or(*found, "points", wish.points, 1, 20, inside);
  if (const auto ranges = found->find("ranges"); ranges != found->end()) {
    if (!ranges->is_object()) refuse(inside, "ranges", *ranges, "must be an object of inputs");
    for (const auto& [key, value] : ranges->items())
      wish.ranges.push_back(given_range(fit, key, value, inside + ": ranges"));
  }
  if (const auto targets = found->find("targets"); targets != found->end()) {
    if (!targets->is_array() || targets->empty()) refuse(inside, "targets", *targets, "must be a list of objects");
    for (const Json& value : *targets) {
      if (!value.is_object() || value.empty()) refuse(inside, "targets", value, "must be objects of inputs");
      wish.targets.push_back(given_target(fit, value, inside + ": targets"));
    }
  }
  return wish;
}

}  // namespace rollres
