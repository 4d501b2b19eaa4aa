#include "studies/file_schema/schema_parts.hpp"

#include <cmath>
#include <stdexcept>

#include "studies/fit/fit_keys.hpp"
#include "studies/scene_io/master_curve_file.hpp"

namespace rollres::json_schema {

namespace {

std::string described(const Quantity& quantity) {
  std::string text(quantity.meaning);
  if (!quantity.symbol.empty()) text = std::string(quantity.symbol) + ": " + text;
  if (quantity.unit.empty() || quantity.unit == "1") return text;
  text += quantity.unit_2d.empty() ? " [" + std::string(quantity.unit) + "]"
                                   : " [" + std::string(quantity.unit_2d) + " for a cylinder without width, else " +
                                         std::string(quantity.unit) + "]";
  return text;
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

/// The names of tables, of a scene or of a layer.
Json table_texts() {
  Json texts = Json::object();
  texts[std::string(master_curve_key)] = {
      {"type", "string"},
      {"minLength", 1},
      {"description",
       "CSV file with the lists of a master curve, relative to this file: frequency [Hz], "
       "storage_modulus [Pa], loss_modulus [Pa]; or of a relaxation or creep test: time [s], relaxation_modulus [Pa] "
       "or creep_compliance [1/Pa]"}};
  texts[std::string(strain_sweep_key)] = {
      {"type", "string"},
      {"minLength", 1},
      {"description",
       "CSV file with a strain sweep at one frequency, relative to this file: strain [1] or [%], rising, "
       "storage_modulus [Pa], loss_modulus [Pa]"}};
  texts[std::string(shift_table_key)] = {
      {"type", "string"},
      {"minLength", 1},
      {"description",
       "CSV file with a table of shifts, relative to this file: temperature [K] or [degC], a_T or log10_a_T, b_T"}};
  texts[std::string(ignored_columns_key)] = {
      {"type", "array"}, {"items", name()}, {"description", "columns of these files that are left out"}};
  return texts;
}

/// One of a scene's further layers.
Json further_layer() {
  Json properties = Json::object(), needed = Json::array();
  for (const InputKind& kind : layer_kinds()) {
    properties[std::string(kind.quantity.key)] = input(kind);
    if (kind.needed_by_all()) needed.push_back(kind.quantity.key);
  }
  properties.update(table_texts());
  return {{"type", "object"}, {"properties", properties}, {"required", needed}, {"additionalProperties", false}};
}

Json form_of(const KeyForm& form) {
  switch (form.kind) {
    case KeyForm::text:
      return {{"type", "string"}};
    case KeyForm::name:
      return name();
    case KeyForm::number:
      return input_number();
    case KeyForm::positive:
      return {{"type", "number"}, {"exclusiveMinimum", 0}};
    case KeyForm::boolean:
      return {{"type", "boolean"}, {"default", false}};
    case KeyForm::whole:
      return whole(form.lowest, form.highest);
    case KeyForm::one_of:
      return names(form.names);
    case KeyForm::own:
      break;
  }
  return {};
}

}  // namespace

Json names(std::span<const std::string_view> list) {
  Json all = Json::array();
  for (const std::string_view name : list) all.push_back(name);
  return {{"type", "string"}, {"enum", all}};
}

Json reference(const std::string& name) { return {{"$ref", "#/definitions/" + name}}; }

Json common_definitions() {
  const Json text{{"type", "string"},
                  {"pattern", R"(^[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?(\s*[^0-9\s.]|\s+1/).*$)"}};
  return {{with_unit, text}};
}

Json input_definitions() {
  Json definitions = common_definitions();
  for (const InputKind& kind : written_kinds()) definitions[std::string(kind.quantity.key)] = input(kind);
  return definitions;
}

Json input(const InputKind& kind) {
  if (kind.layers) {
    Json layers = list_of(further_layer());
    layers["description"] = described(kind.quantity);
    return layers;
  }
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

Json input_reference(const InputKind& kind) { return reference(std::string(kind.quantity.key)); }

bool any_input(const InputKind&) { return true; }
bool real_input(const InputKind& kind) { return kind.real(); }
bool no_list(const InputKind& kind) { return !kind.list; }

std::string layer_pattern(std::string_view own_key) {
  std::string lists;
  for (const InputKind& kind : input_kinds())
    if (kind.layers) lists += (lists.empty() ? "" : "|") + std::string(kind.quantity.key);
  return "^(" + lists + R"()\[(0|[1-9][0-9]?[0-9]?)\]\.)" + std::string(own_key) + "$";
}

Json input_key(bool (*accepts)(const InputKind&)) {
  std::vector<std::string_view> own;
  for (const InputKind& kind : written_kinds())
    if (accepts(kind)) own.push_back(kind.quantity.key);
  std::string of_layers;
  for (const InputKind& kind : layer_kinds())
    if (accepts(kind)) of_layers += (of_layers.empty() ? "" : "|") + std::string(kind.quantity.key);
  return {{"anyOf", {names(own), {{"type", "string"}, {"pattern", layer_pattern("(" + of_layers + ")")}}}}};
}

Json object_of(std::span<const FileKey> keys, const std::vector<std::pair<std::string_view, Json>>& own) {
  Json properties = Json::object(), required = Json::array();
  std::size_t taken = 0;
  for (const FileKey& key : keys) {
    Json form = form_of(key.form);
    if (form.is_null()) {
      const auto found = find_if(own, [&](const auto& named) { return named.first == key.key; });
      if (found == own.end()) throw std::logic_error("a schema has no form for " + std::string(key.key));
      form = found->second;
      ++taken;
    }
    form["description"] = key.meaning;
    properties[std::string(key.key)] = std::move(form);
    if (key.needed) required.push_back(key.key);
  }
  if (taken != own.size()) throw std::logic_error("a schema has forms that belong to no key");
  Json schema{{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
  if (!required.empty()) schema["required"] = required;
  return schema;
}

Json name() { return {{"type", "string"}, {"minLength", 1}}; }

Json whole(int lowest, int highest) { return {{"type", "integer"}, {"minimum", lowest}, {"maximum", highest}}; }

Json list_of(const Json& item) { return {{"type", "array"}, {"items", item}, {"minItems", 1}}; }

Json input_number() { return {{"anyOf", {{{"type", "number"}}, reference(with_unit)}}}; }

Json ignored_texts() {
  Json texts = Json::object();
  for (const FileKey& key : fit_keys)
    if (find_name(ignored_keys, key.key) >= 0)
      texts[std::string(key.key)] = {{"type", "string"}, {"description", key.meaning}};
  return texts;
}

Json scene_texts() {
  Json texts = ignored_texts();
  texts.update(table_texts());
  texts[std::string(profile_key)] = {{"type", "string"},
                                     {"minLength", 1},
                                     {"description",
                                      "CSV file with the profile of a roller along its axle, relative to this file: y "
                                      "[m], rising, height [m] counted from the smallest"}};
  return texts;
}

Json scene_or_file() {
  Json scene = inputs(input_reference, any_input);
  scene["properties"].update(scene_texts());
  return {{"anyOf", {name(), scene}}};
}

std::string printed(const Json& schema) { return schema.dump(2) + '\n'; }

}  // namespace rollres::json_schema
