#include "core/scene/solution.hpp"
#include "studies/file_schema/json_schema.hpp"
#include "studies/file_schema/schema_parts.hpp"
#include "studies/fit/fit_keys.hpp"
#include "studies/optimise/design_keys.hpp"
#include "studies/study/study_outputs.hpp"

namespace rollres {

using namespace json_schema;

namespace {

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
  const Json set{{"anyOf", {name(), reference(data_set_name)}}};
  return object_of(fit_keys, {{"scene", scene_or_file()},
                              {"set", inputs_and_layers(input_reference, any_input)},
                              {"data", {{"anyOf", {name(), reference(data_set_name), list_of(set)}}}},
                              {"parameters", parameters},
                              {"output", names(number_outputs())},
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

std::string fit_schema() {
  Json schema{{"$schema", draft}, {"title", "fit of rollres"}, {"type", "object"}};
  schema["if"] = {{"required", {"material"}}};
  schema["then"] = material_fit();
  schema["else"] = scene_fit();
  Json& definitions = schema["definitions"] = input_definitions();
  definitions[parameter_name] = object_of(fit_parameter_keys);
  definitions[data_set_name] = object_of(data_set_keys, {{"set", inputs_and_layers(input_reference, any_input)}});
  return printed(schema);
}

std::string optimisation_schema() {
  const Json set = inputs_and_layers(input_reference, any_input);
  Json variables = inputs_and_layers([](const InputKind&) { return reference(variable_name); }, real_input);
  variables["minProperties"] = 1;
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
