#include "studies/stored/accepted_study.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "studies/scene_io/doubtful_number.hpp"
#include "studies/scene_io/master_curve_file.hpp"
#include "studies/scene_io/scene_inputs.hpp"
#include "studies/text/strict_json.hpp"
#include "studies/text/units.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

bool all_numbers(const Json& value) {
  return value.is_array() && !value.empty() && all_of(value, [](const Json& item) { return item.is_number(); });
}

void say_units(Json& value);

/// What stands under the key of an input: a value, values of an axis, ends of a range, a distribution.
void say_units_of_input(Json& value, const InputKind& kind) {
  constexpr std::array numbers{"from", "to", "start", "lowest", "highest", "values", "prior", "mean", "sigma"};
  constexpr std::array distributions{"normal", "uniform", "loguniform", "triangular"};
  if (value.is_number()) {
    value = written_input(kind.quantity, value.get<double>());
  } else if (kind.list && all_numbers(value)) {
    value = written_input(kind.quantity, value.get<std::vector<double>>());
  } else if (kind.layers) {
    say_units(value);
  } else if (value.is_array()) {
    for (Json& item : value) say_units_of_input(item, kind);
  } else if (value.is_object()) {
    for (const auto& names : {std::span<const char* const>(numbers), std::span<const char* const>(distributions)})
      for (const char* const name : names)
        if (const auto found = value.find(name); found != value.end()) say_units_of_input(*found, kind);
    if (const auto found = value.find("lognormal"); found != value.end() && found->is_array() && !found->empty())
      say_units_of_input(found->front(), kind);
  }
}

/// A condition "layer_thickness <= 6" with the unit of its limit.
void say_unit_of_limit(Json& condition) {
  const auto text = condition.get<std::string>();
  const std::size_t sign = text.find_first_of("<>");
  if (sign == std::string::npos) return;
  const std::size_t after = text.find_first_not_of("<>=", sign);
  const std::string_view right = trimmed(std::string_view(text).substr(std::min(after, text.size())));
  const std::optional<Quantity> quantity = quantity_named(std::string(trimmed(text.substr(0, sign))));
  const std::optional<double> limit = plain_number(right);
  if (quantity && limit && !doubt_of_limit(*quantity, quantity->unit, *limit).empty())
    condition = text + " [" + std::string(quantity->unit) + "]";
}

void say_units_of_limits(Json& conditions) {
  for (Json& item : conditions)
    if (item.is_string())
      say_unit_of_limit(item);
    else if (item.is_object() && item.contains("condition") && item["condition"].is_string())
      say_unit_of_limit(item["condition"]);
}

/// Of moduli whose kind decides what they are worth.
void say_kind_of_moduli(Json& object) {
  const std::string said(listed_moduli_key);
  const bool series = object.contains("relaxation_moduli") && object.contains("static_young_modulus");
  const auto listed = object.find(std::string(master_curve_inputs[1]));
  if (!object.contains(said) && (series || (listed != object.end() && listed->is_array()))) object[said] = "shear";
}

void say_units(Json& value) {
  if (value.is_object()) say_kind_of_moduli(value);
  if (value.is_object())
    for (const auto& [key, item] : value.items())
      if (key == "constraints" || key == "probability")
        say_units_of_limits(item);
      else if (const InputKind* const kind = find_number(key))
        say_units_of_input(item, *kind);
      else
        say_units(item);
  else if (value.is_array())
    for (Json& item : value) say_units(item);
}

}  // namespace

std::string accepted_study(const std::string& definition) {
  const Json former = Json::parse(definition, nullptr, false);
  if (!former.is_object()) return definition;
  Json accepted = former;
  say_units(accepted);
  return accepted == former ? definition : accepted.dump(2) + (definition.ends_with('\n') ? "\n" : "");
}

}  // namespace rollres
