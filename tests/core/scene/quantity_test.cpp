#include "core/scene/scene.hpp"
#include "core/scene/solution.hpp"
#include "tests/catch.hpp"

using namespace rollres;

TEST_CASE("a misspelt key finds the nearest known one", "[core][quantity]") {
  const auto keys = input_keys();
  CHECK(nearest_name(keys, "raduis") == "radius");
  CHECK(nearest_name(keys, "layer_thicknes") == "layer_thickness");
  CHECK(nearest_name(keys, "thickness") == "layer_thickness");
  CHECK(nearest_name(keys, "thick").empty());
  CHECK(nearest_name(keys, "colour").empty());
}
