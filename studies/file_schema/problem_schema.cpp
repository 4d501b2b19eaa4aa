#include <array>

#include "core/scene/solution.hpp"
#include "fitting/descent/fit_problem.hpp"
#include "fitting/fit/material_fit.hpp"
#include "studies/file_schema/json_schema.hpp"
#include "studies/file_schema/schema_parts.hpp"
#include "studies/fit/fit_keys.hpp"
#include "studies/optimise/design.hpp"
#include "studies/optimise/design_keys.hpp"
#include "studies/study/study_outputs.hpp"

namespace rollres {

using namespace json_schema;

namespace {

constexpr const char* parameter_name = "fitted input";
constexpr const char* data_set_name = "data set";
constexpr const char* variable_name = "variable";

Json one_of_names(std::initializer_list<std::string_view> list) { return names(std::vector<std::string_view>(list)); }

Json positive_number() { return {{"type", "number"}, {"exclusiveMinimum", 0}}; }

Json starts() { return whole(1, 1000); }
Json seed() { return whole(0, 2'000'000'000); }

Json percentage() {
  return {{"type", "string"}, {"pattern", R"(^[+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?\s*%$)"}};
}

Json fitted_input() {
  return object_of(fit_parameter_keys,
                   {{"start", input_number()},
                    {"lowest", input_number()},
                    {"highest", input_number()},
                    {"scale", names(spacing_names)},
                    {"fixed", boolean(false)},
                    {"data", name()}},
                   {});
}

Json data_set() {
  return object_of(data_set_keys,
                   {{"file", name()},
                    {"name", name()},
                    {"set", inputs_and_layers(input_reference, any_input)},
                    {"sigma", input_number()},
                    {"comment", text()}},
                   {"file"});
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
  return object_of(fit_keys,
                   {{"$schema", text()},
                    {"fit", name()},
                    {"comment", text()},
                    {"scene", scene_or_file()},
                    {"set", inputs_and_layers(input_reference, any_input)},
                    {"data", {{"anyOf", {name(), reference(data_set_name), list_of(set)}}}},
                    {"parameters", parameters},
                    {"output", names(number_outputs())},
                    {"weights", one_of_names({"uniform", "relative"})},
                    {"loss", names(ChoiceNames<Loss>::names)},
                    {"loss_scale", positive_number()},
                    {"starts", starts()},
                    {"seed", seed()},
                    {"step", {{"type", "number"}, {"exclusiveMinimum", 0}, {"maximum", 0.1}}}},
                   {"fit", "scene", "data", "parameters"});
}

Json material_fit() {
  return object_of(material_fit_keys,
                   {{"$schema", text()},
                    {"fit", name()},
                    {"comment", text()},
                    {"material", names(ChoiceNames<MaterialForm>::names)},
                    {"data", name()},
                    {"terms", {{"anyOf", {whole(1, 100), {{"const", "auto"}}}}}},
                    {"shift", one_of_names({"none", "wlf", "arrhenius"})},
                    {"reference_temperature", {{"anyOf", {positive_number(), reference(with_unit)}}}},
                    {"sigma", percentage()},
                    {"modulus", one_of_names({"shear", "young"})},
                    {"starts", starts()},
                    {"seed", seed()}},
                   {"fit", "material", "data"});
}

/// "minimise" or "maximise", and not both.
Json one_goal() { return {{{"required", {"minimise"}}}, {{"required", {"maximise"}}}}; }

Json variable() {
  return object_of(
      variable_keys,
      {{"from", input_number()}, {"to", input_number()}, {"scale", names(spacing_names)}, {"start", input_number()}},
      {"from", "to"});
}

}  // namespace

std::string fit_schema() {
  Json schema{{"$schema", draft}, {"title", "fit of rollres"}, {"type", "object"}};
  schema["if"] = {{"required", {"material"}}};
  schema["then"] = material_fit();
  schema["else"] = scene_fit();
  Json& definitions = schema["definitions"] = input_definitions();
  definitions[parameter_name] = fitted_input();
  definitions[data_set_name] = data_set();
  return printed(schema);
}

std::string optimisation_schema() {
  const Json set = inputs_and_layers(input_reference, any_input);
  Json variables = inputs_and_layers([](const InputKind&) { return reference(variable_name); }, real_input);
  variables["minProperties"] = 1;
  const Json duty = object_of(duty_keys, {{"set", set}, {"weight", positive_number()}}, {});
  Json pareto = object_of(pareto_keys, {{"minimise", name()}, {"maximise", name()}, {"points", whole(2, most_points)}},
                          {"points"});
  pareto["oneOf"] = one_goal();
  Json schema{{"$schema", draft}, {"title", "optimisation of rollres"}};
  schema.update(
      object_of(design_keys,
                {{"$schema", text()},
                 {"study", name()},
                 {"comment", text()},
                 {"scene", scene_or_file()},
                 {"set", set},
                 {"variables", variables},
                 {"minimise", name()},
                 {"maximise", name()},
                 {"scenes", list_of(duty)},
                 {"over_scenes", names(ChoiceNames<OverScenes>::names)},
                 {"constraints", {{"type", "array"}, {"items", name()}}},
                 {"algorithm", names(ChoiceNames<Algorithm>::names)},
                 {"global", boolean(false)},
                 {"stop", object_of(stop_keys,
                                    {{"evaluations", whole(1, most_points)},
                                     {"tolerance", {{"type", "number"}, {"minimum", 1e-8}, {"maximum", 0.1}}}},
                                    {})},
                 {"pareto", pareto}},
                {"study", "scene", "variables"}));
  schema["oneOf"] = one_goal();
  Json& definitions = schema["definitions"] = input_definitions();
  definitions[variable_name] = variable();
  return printed(schema);
}

}  // namespace rollres
