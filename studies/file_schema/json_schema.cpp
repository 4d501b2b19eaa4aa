#include "studies/file_schema/json_schema.hpp"

#include "core/scene/solution.hpp"
#include "db/rows/schema.hpp"
#include "fitting/fit/measured_terms.hpp"
#include "fitting/fit/noise_fit.hpp"
#include "studies/file_schema/schema_parts.hpp"
#include "studies/fit/fit_keys.hpp"
#include "studies/optimise/design_keys.hpp"
#include "studies/scene_io/master_curve_file.hpp"
#include "studies/scene_io/scene_entries.hpp"
#include "studies/study/study_keys.hpp"
#include "studies/study/study_outputs.hpp"
#include "studies/study/trusted_fit.hpp"
#include "studies/study/uncertain_inputs.hpp"

namespace rollres {

using namespace json_schema;

namespace {

bool written_otherwise(const InputKind& kind) {
  const auto is_other = [&](const InputKind& other) { return other.held_as == kind.quantity.key; };
  return any_of(written_kinds(), is_other);
}

/// What several keys of a scene ask of each other.
Json joint_rules() {
  Json rules = Json::array();
  for (const InputKind& kind : written_kinds())
    if (!kind.held_as.empty())
      rules.push_back({{"oneOf", {{{"required", {kind.held_as}}}, {{"required", {kind.quantity.key}}}}}});
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
    if (is_measured_curve(model))
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

constexpr const char* interval_name = "interval";
constexpr const char* range_name = "range";
constexpr const char* chart_name = "chart of a study";
constexpr const char* plain_chart_name = "chart of a study without formulas";

/// A list, or an interval where the input is a number.
Json axis(const InputKind& kind) {
  const Json list = list_of(input_reference(kind));
  return kind.choices.empty() ? Json{{"anyOf", {list, reference(interval_name)}}} : list;
}

/// Named sets of inputs, and what is short for them.
void add_variants(Json& properties) {
  Json inputs = inputs_and_layers(input_reference, any_input);
  inputs["minProperties"] = 1;
  for (const std::string_view key : table_keys) inputs["properties"][std::string(key)] = name();
  properties[std::string(variant_key)] = {{"type", "object"},
                                          {"minProperties", 2},
                                          {"additionalProperties", inputs},
                                          {"description", "named sets of inputs that go together"}};
  Json files = list_of(name());
  files["minItems"] = 2;
  files["description"] = "CSV files, each a variant of its name";
  properties[std::string(master_curve_key)] = files;
}

Json axes() {
  Json schema = inputs_and_layers(axis, no_list);
  Json together = schema;
  together["minProperties"] = 1;
  add_variants(schema["properties"]);
  const Json numbers = {{"type", "array"}, {"items", {{"type", "number"}}}};
  const Json columns = {{"type", "object"}, {"additionalProperties", numbers}, {"minProperties", 1}};
  Json zip = object_of(zip_keys, {{"zip", together}, {"columns", columns}});
  const Json two_inputs = {{"minProperties", 2}};
  zip["anyOf"] = {{{"required", {"columns"}}}, {{"properties", {{"zip", two_inputs}}}}};
  schema["additionalProperties"] = zip;
  schema["minProperties"] = 1;
  return schema;
}

Json sample() {
  Json ranges = inputs_and_layers([](const InputKind&) { return reference(range_name); }, real_input);
  ranges["minProperties"] = 1;
  return object_of(sample_keys, {{"seed", {{"type", "integer"}, {"minimum", 0}, {"default", 0}}}, {"ranges", ranges}});
}

constexpr const char* distribution_name = "distribution";

/// A number of a distribution: of the input, or a share.
Json distribution() {
  const Json number = input_number();
  const auto list = [&](int size) {
    return Json{{"type", "array"}, {"items", number}, {"minItems", size}, {"maxItems", size}};
  };
  const Json share{{"type", "string"}, {"pattern", R"(%\s*$)"}};
  const Json moments{{"anyOf", {share, {{"type", "array"}, {"items", number}, {"minItems", 1}, {"maxItems", 2}}}}};
  Json object = object_of(distribution_keys, {{"normal", moments},
                                              {"lognormal", moments},
                                              {"uniform", list(2)},
                                              {"loguniform", list(2)},
                                              {"triangular", list(3)}});
  Json one = Json::array();
  for (const std::string_view name : ChoiceNames<DistributionKind>::names) one.push_back({{"required", {name}}});
  object["oneOf"] = one;
  return object;
}

Json uncertain() {
  Json schema = inputs_and_layers([](const InputKind&) { return reference(distribution_name); }, real_input);
  const Json number{{"type", "number"}, {"exclusiveMinimum", -1}, {"exclusiveMaximum", 1}};
  const Json pair{{"type", "array"}, {"items", {name(), name(), number}}, {"minItems", 3}, {"maxItems", 3}};
  const Json options = object_of(uncertain_keys, {{"fit", object_of(stored_fit_keys)},
                                                  {"correlation", {{"type", "array"}, {"items", pair}}},
                                                  {"seed", {{"type", "integer"}, {"minimum", 0}, {"default", 1}}},
                                                  {"probability", {{"type", "array"}, {"items", name()}}}});
  schema["properties"].update(options["properties"]);
  return schema;
}

/// Outputs, and formulas by their names.
Json compute() {
  const Json formulas{{"type", "object"},
                      {"minProperties", 1},
                      {"propertyNames", {{"pattern", "^[A-Za-z_][A-Za-z_0-9]*$"}}},
                      {"additionalProperties", name()}};
  return {{"anyOf", {list_of({{"anyOf", {names(output_keys()), formulas}}}), formulas}}};
}

/// @param formulas  whether it may show numbers that the study computes by formulas, whatever their names
Json chart(bool formulas) {
  Json numbers = names(number_outputs());
  const Json formula{{"type", "string"}, {"pattern", "^[A-Za-z_][A-Za-z_0-9]*$"}};
  if (formulas) numbers = {{"anyOf", {numbers, formula}}};
  const Json either{{"anyOf", {input_key(any_input), numbers}}};
  Json varied = input_key(any_input);
  varied["anyOf"].push_back({{"const", variant_key}});
  return object_of(chart_keys, {{"x", either}, {"y", either}, {"family", varied}, {"map", numbers}});
}

constexpr const char* design_range_name = "range of a design";
constexpr const char* parameter_name = "fitted input";
constexpr const char* data_set_name = "data set";
constexpr const char* variable_name = "variable";

Json percentage() {
  return {{"type", "string"}, {"pattern", R"(^[+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?\s*%$)"}};
}

Json scene_fit() {
  Json parameters = inputs_and_layers(
      [](const InputKind&) {
        const Json one = reference(parameter_name);
        return Json{{"anyOf", {input_number(), one, list_of(one)}}};
      },
      real_input);
  parameters["minProperties"] = 1;
  parameters["patternProperties"][R"(^((lower|coating)_layers\[[0-9]+\]\.)?[a-z_]+\[[0-9]+\]$)"] =
      Json{{"anyOf", {input_number(), reference(parameter_name)}}};
  parameters["properties"]["relaxation_moduli"] = reference(parameter_name);
  for (const std::string_view term : {offset_key, scale_key}) {  // of the measured values, no inputs
    const Json one = reference(parameter_name);
    parameters["properties"][std::string(term)] = {{"anyOf", {input_number(), one, list_of(one)}}};
  }
  const Json noise{{"type", "object"}, {"properties", {{"data", name()}}}, {"additionalProperties", false}};
  for (const std::string_view term : {noise_level_key, relative_noise_key})
    parameters["properties"][std::string(term)] = {{"anyOf", {noise, list_of(noise)}}};
  const Json set{{"anyOf", {name(), reference(data_set_name)}}};
  Json ranges = inputs_and_layers([](const InputKind&) { return reference(design_range_name); }, real_input);
  ranges["minProperties"] = 1;
  Json target = inputs_and_layers([](const InputKind&) { return input_number(); }, real_input);
  target["properties"]["data"] = name();
  const Json design = object_of(design_wish_keys, {{"ranges", ranges}, {"targets", list_of(target)}});
  return object_of(fit_keys, {{"scene", scene_or_file()},
                              {"design", design},
                              {"prior", object_of(stored_fit_keys)},
                              {"set", inputs_and_layers(input_reference, any_input)},
                              {"data", {{"anyOf", {name(), reference(data_set_name), list_of(set)}}}},
                              {"parameters", parameters},
                              {"output", names(number_outputs())},
                              {"time_limit", input_number()},
                              {"step", {{"type", "number"}, {"exclusiveMinimum", 0}, {"maximum", 0.1}}}});
}

Json percentage_of_moduli() {
  return {{"anyOf",
           {percentage(),
            object_of(modulus_sigma_keys, {{"storage_modulus", percentage()}, {"loss_modulus", percentage()}})}}};
}

Json material_fit() {
  const Json positive{{"type", "number"}, {"exclusiveMinimum", 0}};
  return object_of(material_fit_keys, {{"terms", {{"anyOf", {whole(1, 100), {{"const", "auto"}}}}}},
                                       {"reference_temperature", {{"anyOf", {positive, reference(with_unit)}}}},
                                       {"ignore_columns", list_of(name())},
                                       {"scene", scene_or_file()},
                                       {"sigma", percentage_of_moduli()}});
}

Json strain_fit() {
  return object_of(
      strain_fit_keys,
      {{"ignore_columns", list_of(name())}, {"scene", scene_or_file()}, {"sigma", percentage_of_moduli()}});
}

Json text_or(const Json& object) { return {{"anyOf", {name(), object}}}; }

/// "minimise" or "maximise", and not both.
Json one_goal() { return {{{"required", {"minimise"}}}, {{"required", {"maximise"}}}}; }

}  // namespace

std::string scene_schema() {
  Json schema{{"$schema", draft}, {"title", "scene of rollres"}};
  schema.update(inputs(input, any_input));
  Json properties = scene_texts();
  properties.update(schema["properties"]);
  schema["properties"] = properties;
  schema["required"] = Json::array();
  for (const InputKind& kind : input_kinds())
    if (kind.needed_by_all() && !written_otherwise(kind)) schema["required"].push_back(kind.quantity.key);
  schema["allOf"] = joint_rules();
  schema["definitions"] = common_definitions();
  return printed(schema);
}

std::string study_schema() {
  Json schema{{"$schema", draft}, {"title", "study of rollres"}};
  schema.update(object_of(study_keys, {{"scene", scene_or_file()},
                                       {"set", inputs_and_layers(input_reference, any_input)},
                                       {"axes", axes()},
                                       {"sample", sample()},
                                       {"uncertain", uncertain()},
                                       {"constraints", list_of(name())},
                                       {"compute", compute()},
                                       {"chart", {{"allOf", {reference(chart_name)}}}},
                                       {"charts", list_of(reference(chart_name))}}));
  schema["anyOf"] = {{{"required", {"axes"}}}, {{"required", {"sample"}}}, {{"required", {"uncertain"}}}};
  schema["not"] = {{"required", {"chart", "charts"}}};
  const Json holds_formula{{"anyOf", {{{"type", "object"}}, {{"type", "array"}, {"contains", {{"type", "object"}}}}}}};
  schema["if"] = {{"required", {"compute"}}, {"properties", {{"compute", holds_formula}}}};
  schema["else"]["properties"] = {{"chart", reference(plain_chart_name)},
                                  {"charts", list_of(reference(plain_chart_name))}};
  Json& definitions = schema["definitions"] = input_definitions();
  definitions[interval_name] = object_of(interval_keys);
  definitions[range_name] = object_of(range_keys);
  definitions[distribution_name] = distribution();
  definitions[chart_name] = chart(true);
  definitions[plain_chart_name] = chart(false);
  return printed(schema);
}

using namespace json_schema;

std::string fit_schema() {
  Json schema{{"$schema", draft}, {"title", "fit of rollres"}, {"type", "object"}};
  schema["if"] = {{"required", {"material"}}};
  schema["then"] = {{"if", {{"properties", {{"material", {{"const", kraus_alone}}}}}}},
                    {"then", strain_fit()},
                    {"else", material_fit()}};
  schema["else"] = scene_fit();
  Json& definitions = schema["definitions"] = input_definitions();
  definitions[design_range_name] = object_of(design_range_keys);
  definitions[parameter_name] = object_of(fit_parameter_keys, {{"prior", object_of(prior_keys)}});
  const Json data_sigma{{"anyOf",
                         {input_number(), object_of(modulus_sigma_keys, {{"storage_modulus", percentage()},
                                                                         {"loss_modulus", percentage()}})}}};
  definitions[data_set_name] = object_of(data_set_keys, {{"set", inputs_and_layers(input_reference, any_input)},
                                                         {"output", name()},
                                                         {"sigma", data_sigma},
                                                         {"ignore_columns", list_of(name())}});
  return printed(schema);
}

std::string optimisation_schema() {
  const Json set = inputs_and_layers(input_reference, any_input);
  Json variables = inputs_and_layers(
      [](const InputKind& kind) {
        const Json list = list_of(input_reference(kind));
        return kind.real() ? Json{{"anyOf", {reference(variable_name), list}}} : list;
      },
      no_list);
  variables["properties"].erase("indenter");
  variables["minProperties"] = 1;
  add_variants(variables["properties"]);
  const Json goal = text_or(object_of(goal_keys));
  Json pareto = object_of(pareto_keys, {{"minimise", goal}, {"maximise", goal}});
  pareto["oneOf"] = one_goal();
  const Json tolerance{{"type", "number"}, {"minimum", 1e-8}, {"maximum", 0.1}};
  Json schema{{"$schema", draft}, {"title", "optimisation of rollres"}};
  schema.update(
      object_of(design_keys, {{"scene", scene_or_file()},
                              {"set", set},
                              {"variables", variables},
                              {"compute", compute()},
                              {"scenes", list_of(object_of(duty_keys, {{"set", set}}))},
                              {"minimise", goal},
                              {"maximise", goal},
                              {"constraints", {{"type", "array"}, {"items", text_or(object_of(constraint_keys))}}},
                              {"uncertain", uncertain()},
                              {"stop", object_of(stop_keys, {{"tolerance", tolerance}})},
                              {"pareto", pareto}}));
  schema["oneOf"] = one_goal();
  Json& definitions = schema["definitions"] = input_definitions();
  definitions[variable_name] = object_of(variable_keys);
  definitions[distribution_name] = distribution();
  return printed(schema);
}

}  // namespace rollres
