// Covers listed_inputs and listed_outputs, too.

#include "core/scene/scene_input.hpp"

#include <limits>
#include <map>
#include <utility>

#include "core/derivatives/objective.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"

using namespace rollres;

namespace {

/// Two layers below the first, one on the body.
RollingScene layered_scene() {
  RollingScene scene = plain_scene();
  BondedLayer layer;
  layer.static_shear_modulus = 2e6;
  layer.stiffening = 1;
  layer.creep_time = 0.01;
  layer.layer_thickness = 0.004;
  scene.lower_layers = {layer, layer};
  scene.lower_layers[1].layer_thickness = std::numeric_limits<double>::infinity();
  scene.coating_layers = {layer};
  return scene;
}

}  // namespace

TEST_CASE("a key of a further layer is a list, a place in it from 0 on, and an input", "[core][scene_input]") {
  const LayerKey key = layer_key("coating_layers[12].layer_thickness").value();
  CHECK(key.list == "coating_layers");
  CHECK(key.layer == 12);
  CHECK(key.input == "layer_thickness");
  CHECK(key.layer_in_words() == "coating [12]");
  CHECK(layer_key("lower_layers[0].stiffening")->layer_in_words() == "lower layer [0]");
  CHECK(own_key("lower_layers[0].stiffening") == "stiffening");
  CHECK(own_key("stiffening") == "stiffening");
  for (const char* const other :
       {"layer_thickness", "a[0]b", "a[].b", "a[-1].b", "a[01].b", "a[1.5].b", "a[0].", "[0].b", "a[1000].b", "a]0[.b"})
    CHECK_FALSE(layer_key(other));
}

TEST_CASE("every input of a scene and of its layers is found by its key, and by no other", "[core][scene_input]") {
  RollingScene scene = layered_scene();
  std::map<std::string_view, std::pair<const Quantity*, const void*>> inputs;
  std::size_t visited = 0;
  visit_all_inputs(scene, [&](const Quantity& quantity, auto& value) {
    inputs[quantity.key] = {&quantity, &value};
    ++visited;
  });
  CHECK(inputs.size() == visited);
  for (const auto& [key, input] : inputs) {
    CAPTURE(key);
    std::pair<const Quantity*, const void*> found{};
    CHECK(visit_input(scene, key, [&](const Quantity& same, auto& here) { found = {&same, &here}; }));
    CHECK(found == input);
  }
  std::size_t of_a_layer = 0;
  visit_layer_inputs(scene, [&](const Quantity&, const auto&) { ++of_a_layer; });
  CHECK(visited == input_keys().size() + 3 * of_a_layer);
  for (const char* const absent : {"coating_layers[1].stiffening", "coating_layers[0].load", "period[0].stiffening"})
    CHECK_FALSE(visit_input(scene, absent, [](const Quantity&, const auto&) {}));
  CHECK(absent_layer(scene, "lower_layers[2].stiffening") == "the scene has 2 layers in lower_layers: [0] to [1]");
  CHECK(absent_layer(scene, "lower_layers[1].stiffening").empty());
  CHECK(absent_layer(scene, "lower_layers[2].load").empty());
}

TEST_CASE("a number of a list is an input by its place from 0 on", "[core][scene_input]") {
  CHECK(element_key("relaxation_moduli[2]")->list == "relaxation_moduli");
  CHECK(element_key("coating_layers[0].relaxation_moduli[12]")->list == "coating_layers[0].relaxation_moduli");
  CHECK(element_key("coating_layers[0].relaxation_moduli[12]")->place == 12);
  for (const char* const other : {"a", "a[]", "a[-1]", "a[01]", "a[0]b", "[0]", "a[1000]", "a[0", "a[0].b"})
    CHECK_FALSE(element_key(other));

  RollingScene scene = layered_scene();
  scene.relaxation_moduli = {1e6, 2e6};
  scene.lower_layers[1].relaxation_moduli = {3e6};
  const Objective f = objective(scene, {{"relaxation_moduli[1]"}, {"lower_layers[1].relaxation_moduli[0]"}},
                                "rolling_resistance", closed_form);
  CHECK(f.variables[0].quantity.unit == "Pa");
  CHECK(f.variables[0].quantity.key == "relaxation_moduli[1]");
  CHECK(f.variables[0].scaling == Scaling::logarithmic);
  CHECK(base_point(f) == std::vector<double>{2e6, 3e6});
  const RollingScene moved = scene_at(f, std::vector<double>{5e6, 7e6});
  CHECK(moved.relaxation_moduli == std::vector<double>{1e6, 5e6});
  CHECK(moved.lower_layers[1].relaxation_moduli == std::vector<double>{7e6});
  CHECK(moved.lower_layers[0].relaxation_moduli.empty());

  const auto refusal = [&](const char* key) { return message_of([&] { variables_of(scene, {{key}}); }); };
  CHECK(refusal("relaxation_moduli[2]") == "relaxation_moduli[2]: the scene has 2 relaxation_moduli: [0] to [1]");
  CHECK(refusal("relaxation_times[0]") == "relaxation_times[0]: the scene has no relaxation_times");
  CHECK(refusal("relaxation_moduli") == "relaxation_moduli: must be an input that is a real number");
  CHECK(refusal("radius[0]").find("radius[0]: unknown input") == 0);
}

TEST_CASE("an objective may vary a further layer's inputs", "[core][scene_input][objective]") {
  const RollingScene scene = layered_scene();
  const Objective f =
      objective(scene, {{"coating_layers[0].layer_thickness", 1e-3, 1e-2}, {"lower_layers[1].stiffening"}},
                "rolling_resistance", closed_form);
  CHECK(f.variables[0].quantity.symbol == "H of coating [0]");
  CHECK(f.variables[0].scaling == Scaling::logarithmic);
  CHECK(base_point(f) == std::vector<double>{0.004, 1});
  const RollingScene moved = scene_at(f, std::vector<double>{0.002, 3});
  CHECK(moved.coating_layers[0].layer_thickness == 0.002);
  CHECK(moved.lower_layers[1].stiffening == 3);
  CHECK(moved.lower_layers[0].stiffening == 1);
  CHECK(moved.layer_thickness == scene.layer_thickness);

  const auto refusal = [&](const char* key) { return message_of([&] { variables_of(scene, {{key}}); }); };
  CHECK(refusal("coating_layers[1].stiffening") ==
        "coating_layers[1].stiffening: the scene has one layer in coating_layers: coating_layers[0]");
  CHECK(refusal("coating_layers[0].stifening") ==
        "coating_layers[0].stifening: unknown input; did you mean coating_layers[0].stiffening?");
  CHECK(refusal("coating_layers[0].material") == "coating_layers[0].material: must be an input that is a real number");
  CHECK(refusal("lower_layers[1].layer_thickness") ==
        "lower_layers[1].layer_thickness = \"infinite\": must be finite to be varied");
}
