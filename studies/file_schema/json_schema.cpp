#include "studies/file_schema/json_schema.hpp"

#include "core/scene/solution.hpp"
#include "db/rows/schema.hpp"
#include "fitting/fit/measured_terms.hpp"
#include "studies/file_schema/schema_parts.hpp"
#include "studies/fit/fit_keys.hpp"
#include "studies/optimise/design_keys.hpp"
#include "studies/scene_io/master_curve_file.hpp"
#include "studies/scene_io/scene_entries.hpp"
#include "studies/study/study_keys.hpp"
#include "studies/study/study_outputs.hpp"

namespace rollres {

using namespace json_schema;

namespace {

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

constexpr const char* interval_name = "interval";
constexpr const char* range_name = "range";
constexpr const char* chart_name = "chart of a study";

/// A list, or an interval where the input is a number.
Json axis(const InputKind& kind) {
  const Json list = list_of(input_reference(kind));
  return kind.choices.empty() ? Json{{"anyOf", {list, reference(interval_name)}}} : list;
}

/// Named sets of inputs, and what is short for them.
void add_variants(Json& properties) {
  Json inputs = inputs_and_layers(input_reference, any_input);
  inputs["minProperties"] = 1;
  inputs["properties"][std::string(master_curve_key)] = name();
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
  together["minProperties"] = 2;
  add_variants(schema["properties"]);
  schema["additionalProperties"] = object_of(zip_keys, {{"zip", together}});
  schema["minProperties"] = 1;
  return schema;
}

Json sample() {
  Json ranges = inputs_and_layers([](const InputKind&) { return reference(range_name); }, real_input);
  ranges["minProperties"] = 1;
  return object_of(sample_keys, {{"seed", {{"type", "integer"}, {"minimum", 0}, {"default", 0}}}, {"ranges", ranges}});
}

Json chart() {
  const Json numbers = names(number_outputs()), either{{"anyOf", {input_key(any_input), numbers}}};
  Json varied = input_key(any_input);
  varied["anyOf"].push_back({{"const", variant_key}});
  return object_of(chart_keys, {{"x", either}, {"y", either}, {"family", varied}, {"map", numbers}});
}

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
  for (const std::string_view term : {offset_key, scale_key}) {  // of the measured values, no inputs
    const Json one = reference(parameter_name);
    parameters["properties"][std::string(term)] = {{"anyOf", {input_number(), one, list_of(one)}}};
  }
  const Json set{{"anyOf", {name(), reference(data_set_name)}}};
  return object_of(fit_keys, {{"scene", scene_or_file()},
                              {"set", inputs_and_layers(input_reference, any_input)},
                              {"data", {{"anyOf", {name(), reference(data_set_name), list_of(set)}}}},
                              {"parameters", parameters},
                              {"output", names(number_outputs())},
                              {"time_limit", input_number()},
                              {"step", {{"type", "number"}, {"exclusiveMinimum", 0}, {"maximum", 0.1}}}});
}

Json material_fit() {
  const Json positive{{"type", "number"}, {"exclusiveMinimum", 0}};
  return object_of(material_fit_keys, {{"terms", {{"anyOf", {whole(1, 100), {{"const", "auto"}}}}}},
                                       {"reference_temperature", {{"anyOf", {positive, reference(with_unit)}}}},
                                       {"sigma", percentage()}});
}

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
    if (kind.needed_by_all()) schema["required"].push_back(kind.quantity.key);
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
                                       {"constraints", list_of(name())},
                                       {"compute", list_of(names(output_keys()))},
                                       {"chart", {{"allOf", {reference(chart_name)}}}},
                                       {"charts", list_of(reference(chart_name))}}));
  schema["anyOf"] = {{{"required", {"axes"}}}, {{"required", {"sample"}}}};
  schema["not"] = {{"required", {"chart", "charts"}}};
  Json& definitions = schema["definitions"] = input_definitions();
  definitions[interval_name] = object_of(interval_keys);
  definitions[range_name] = object_of(range_keys);
  definitions[chart_name] = chart();
  return printed(schema);
}

using namespace json_schema;

std::string fit_schema() {
  Json schema{{"$schema", draft}, {"title", "fit of rollres"}, {"type", "object"}};
  schema["if"] = {{"required", {"material"}}};
  schema["then"] = material_fit();
  schema["else"] = scene_fit();
  Json& definitions = schema["definitions"] = input_definitions();
  definitions[parameter_name] = object_of(fit_parameter_keys, {{"prior", object_of(prior_keys)}});
  definitions[data_set_name] =
      object_of(data_set_keys, {{"set", inputs_and_layers(input_reference, any_input)}, {"output", name()}});
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
  Json pareto = object_of(pareto_keys);
  pareto["oneOf"] = one_goal();
  const Json tolerance{{"type", "number"}, {"minimum", 1e-8}, {"maximum", 0.1}};
  Json schema{{"$schema", draft}, {"title", "optimisation of rollres"}};
  schema.update(object_of(design_keys, {{"scene", scene_or_file()},
                                        {"set", set},
                                        {"variables", variables},
                                        {"scenes", list_of(object_of(duty_keys, {{"set", set}}))},
                                        {"constraints", {{"type", "array"}, {"items", name()}}},
                                        {"stop", object_of(stop_keys, {{"tolerance", tolerance}})},
                                        {"pareto", pareto}}));
  schema["oneOf"] = one_goal();
  Json& definitions = schema["definitions"] = input_definitions();
  definitions[variable_name] = object_of(variable_keys);
  return printed(schema);
}

}  // namespace rollres
