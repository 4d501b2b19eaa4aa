#include "studies/json_schema.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/solution.hpp"
#include "studies/master_curve_file.hpp"
#include "studies/sampling.hpp"
#include "studies/scene_entries.hpp"
#include "studies/study_keys.hpp"
#include "studies/study_wishes.hpp"

namespace rollres {

namespace {

constexpr const char* draft = "http://json-schema.org/draft-07/schema#";

std::string described(const Quantity& quantity) {
  std::string text(quantity.meaning);
  if (!quantity.symbol.empty()) text = std::string(quantity.symbol) + ": " + text;
  if (quantity.unit.empty() || quantity.unit == "1") return text;
  text += quantity.unit_2d.empty() ? " [" + std::string(quantity.unit) + "]"
                                   : " [" + std::string(quantity.unit_2d) + " for a cylinder, " +
                                         std::string(quantity.unit) + " for a sphere]";
  return text;
}

Json names(std::span<const std::string_view> list) {
  Json all = Json::array();
  for (const std::string_view name : list) all.push_back(name);
  return {{"type", "string"}, {"enum", all}};
}

Json list_of(const Json& item) { return {{"type", "array"}, {"items", item}, {"minItems", 1}}; }

/// A definition of the schema by its name.
Json reference(const std::string& name) { return {{"$ref", "#/definitions/" + name}}; }

constexpr const char* with_unit = "number with a unit";

/// What all schemas define: texts such as "5 mm".
Json common_definitions() {
  const Json text{{"type", "string"},
                  {"pattern", R"(^[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?\s*[^0-9\s.].*$)"}};
  return {{with_unit, text}};
}

Json number(const InputKind& kind) {
  const Range& range = kind.quantity.range;
  Json plain{{"type", kind.whole ? "integer" : "number"}};
  if (std::isfinite(range.lowest)) plain[range.lowest_excluded ? "exclusiveMinimum" : "minimum"] = range.lowest;
  if (std::isfinite(range.highest)) plain["maximum"] = range.highest;
  if (kind.whole) return plain;
  Json forms{plain, reference(with_unit)};
  if (range.infinity_allowed) forms.push_back({{"const", "infinite"}});
  return {{"anyOf", forms}};
}

Json input(const InputKind& kind) {
  Json schema = kind.choices.empty() ? number(kind) : names(kind.choices);
  if (kind.list) schema = list_of(schema);
  schema["description"] = described(kind.quantity);
  if (kind.optional || kind.list || !kind.needed_by().empty()) return schema;
  if (const auto* const name = std::get_if<std::string>(&kind.default_value))
    schema["default"] = *name;
  else
    schema["default"] = std::get<double>(kind.default_value);
  return schema;
}

/// Keys of a scene that are no inputs.
Json scene_texts() {
  Json texts = Json::object();
  for (const FileKey& key : study_keys)
    if (find_name(ignored_keys, key.key) >= 0)
      texts[std::string(key.key)] = {{"type", "string"}, {"description", key.meaning}};
  texts[std::string(master_curve_key)] = {
      {"type", "string"},
      {"minLength", 1},
      {"description",
       "CSV file with the lists of a master curve, relative to this file: frequency [Hz], "
       "storage_modulus [Pa], loss_modulus [Pa]"}};
  return texts;
}

/// What several keys of a scene ask of each other.
Json joint_rules() {
  Json rules = Json::array();
  for (const InputKind& kind : input_kinds())
    if (kind.optional)
      for (const std::string_view other : replaced_inputs(kind.quantity.key, 0.0))
        if (kind.quantity.key < other) rules.push_back({{"not", {{"required", {kind.quantity.key, other}}}}});
  const InputKind& material = *find_input("material");
  // One of two sets of keys.
  const auto either = [](const Json& one, const Json& other) {
    Json ways = Json::array();
    for (const Json& keys : {one, other}) ways.push_back({{"required", keys}});
    return Json{{"anyOf", ways}};
  };
  for (std::size_t i = 0; i < material.choices.size(); ++i) {
    const std::string name(material.choices[i]);
    const auto model = static_cast<MaterialModel>(i);
    Json needed = Json::array(), wanted = Json::array();
    for (const InputKind& kind : input_kinds())
      if (kind.needed_by(model)) needed.push_back(kind.quantity.key);
    if (model == MaterialModel::master_curve)
      wanted.push_back(either(needed, Json::array({master_curve_key})));
    else if (!needed.empty())
      wanted.push_back({{"required", needed}});
    if (needs_static_modulus(model))
      wanted.push_back(either(Json::array({"static_shear_modulus"}), Json::array({"static_young_modulus"})));
    Json chosen{{"properties", {{"material", {{"const", name}}}}}};
    if (material.default_value != InputValue(name)) chosen["required"] = {"material"};
    rules.push_back({{"if", chosen}, {"then", {{"allOf", wanted}}}});
  }
  return rules;
}

/// An object whose properties are the inputs with these values.
template <class ValueOf>
Json inputs(ValueOf&& value_of, bool (*accepts)(const InputKind&)) {
  Json properties = Json::object();
  for (const InputKind& kind : input_kinds())
    if (accepts(kind)) properties[std::string(kind.quantity.key)] = value_of(kind);
  return {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
}
bool any_input(const InputKind&) { return true; }
bool real_input(const InputKind& kind) { return kind.real(); }
bool no_list(const InputKind& kind) { return !kind.list; }

/// An object of a study file: each of its keys with what it holds.
/// @throws std::logic_error if a key has no form, or a form no key
Json object_of(std::span<const FileKey> keys, const std::vector<std::pair<std::string_view, Json>>& forms,
               const std::vector<std::string_view>& required) {
  if (forms.size() != keys.size()) throw std::logic_error("a schema has not as many forms as keys");
  Json properties = Json::object();
  for (const FileKey& key : keys) {
    const auto form =
        std::find_if(forms.begin(), forms.end(), [&](const auto& named) { return named.first == key.key; });
    if (form == forms.end()) throw std::logic_error("a schema has no form for " + std::string(key.key));
    Json& property = properties[std::string(key.key)] = form->second;
    property["description"] = key.meaning;
  }
  Json schema{{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
  if (!required.empty()) schema["required"] = required;
  return schema;
}

Json whole(int lowest, int highest) { return {{"type", "integer"}, {"minimum", lowest}, {"maximum", highest}}; }

Json input_reference(const InputKind& kind) { return reference(std::string(kind.quantity.key)); }

constexpr const char* interval_name = "interval";
constexpr const char* range_name = "range";
constexpr const char* chart_name = "chart of a study";

/// A list, or an interval where the input is a number.
Json axis(const InputKind& kind) {
  const Json list = list_of(input_reference(kind));
  return kind.choices.empty() ? Json{{"anyOf", {list, reference(interval_name)}}} : list;
}

Json axes() {
  Json schema = inputs(axis, no_list);
  Json together = schema;
  together["minProperties"] = 2;
  schema["additionalProperties"] = object_of(zip_keys, {{"zip", together}}, {"zip"});
  schema["minProperties"] = 1;
  return schema;
}

Json sample() {
  Json ranges = inputs([](const InputKind&) { return reference(range_name); }, real_input);
  ranges["minProperties"] = 1;
  return object_of(sample_keys,
                   {{"method", names(ChoiceNames<SampleMethod>::names)},
                    {"points", whole(1, most_points)},
                    {"seed", {{"type", "integer"}, {"minimum", 0}, {"default", 0}}},
                    {"ranges", ranges}},
                   {"method", "points", "ranges"});
}

/// Of an interval or a range, whichever its input.
Json end_value() { return {{"anyOf", {{{"type", "number"}}, reference(with_unit)}}}; }

Json interval() {
  return object_of(interval_keys,
                   {{"from", end_value()},
                    {"to", end_value()},
                    {"points", whole(2, most_points)},
                    {"spacing", names(spacing_names)}},
                   {"from", "to", "points"});
}

Json range() {
  return object_of(range_keys, {{"from", end_value()}, {"to", end_value()}, {"spacing", names(spacing_names)}},
                   {"from", "to"});
}

Json chart() {
  const Json numbers = names(number_outputs()), varied = names(input_keys());
  return object_of(chart_keys,
                   {{"name", {{"type", "string"}, {"minLength", 1}}},
                    {"x", {{"anyOf", {varied, numbers}}}},
                    {"y", numbers},
                    {"family", varied}},
                   {});
}

std::string printed(const Json& schema) { return schema.dump(2) + '\n'; }

}  // namespace

std::string scene_schema() {
  Json schema{{"$schema", draft}, {"title", "scene of rollres"}};
  schema.update(inputs(input, any_input));
  Json properties = scene_texts();
  properties.update(schema["properties"]);
  schema["properties"] = properties;
  schema["required"] = Json::array();
  for (const InputKind& kind : input_kinds())
    if (kind.needed_by_all()) schema["required"].push_back(kind.quantity.key);
  schema["allOf"] = joint_rules();
  schema["definitions"] = common_definitions();
  return printed(schema);
}

std::string study_schema() {
  Json inline_scene = inputs(input_reference, any_input);
  const Json set = inline_scene;
  inline_scene["properties"].update(scene_texts());
  const Json name{{"type", "string"}, {"minLength", 1}};
  Json schema{{"$schema", draft}, {"title", "study of rollres"}};
  schema.update(object_of(study_keys,
                          {{"$schema", {{"type", "string"}}},
                           {"study", name},
                           {"comment", {{"type", "string"}}},
                           {"scene", {{"anyOf", {name, inline_scene}}}},
                           {"set", set},
                           {"axes", axes()},
                           {"sample", sample()},
                           {"constraints", list_of(name)},
                           {"compute", list_of(names(output_keys()))},
                           {"fields", {{"type", "boolean"}, {"default", false}}},
                           {"chart", {{"allOf", {reference(chart_name)}}}},
                           {"charts", list_of(reference(chart_name))}},
                          {"study", "scene"}));
  schema["anyOf"] = {{{"required", {"axes"}}}, {{"required", {"sample"}}}};
  schema["not"] = {{"required", {"chart", "charts"}}};
  Json& definitions = schema["definitions"] = common_definitions();
  for (const InputKind& kind : input_kinds()) definitions[std::string(kind.quantity.key)] = input(kind);
  definitions[interval_name] = interval();
  definitions[range_name] = range();
  definitions[chart_name] = chart();
  return printed(schema);
}

}  // namespace rollres
