#include "studies/scene_io/usual_names.hpp"

#include "core/scene/scene_input.hpp"
#include "studies/scene_io/scene_inputs.hpp"
#include "tests/catch.hpp"

using namespace rollres;

namespace {

TEST_CASE("an input under its usual name or symbol is refused with the name it has here", "[studies][scene_io]") {
  const auto refusal = [](const std::string& key) { return unknown_input(keys_like(key), key); };
  CHECK(refusal("d_roll") == "unknown key; the key is diameter");
  CHECK(refusal("Velocity") == "unknown key; the key is speed");
  CHECK(refusal("μ") == "unknown key; the key is friction_coefficient");
  CHECK(refusal("P") == "unknown key; the key is load");
  CHECK(refusal("E") == "unknown key; the key is static_young_modulus: at rest");
  CHECK(refusal("radus") == "unknown key; did you mean radius?");
  CHECK(refusal("colour of the wheel") == "unknown key; rollres quantities lists the keys");
}

TEST_CASE("every key that a refusal names is one", "[studies][scene_io]") {
  for (const char* name :
       {"d_roll", "thickness", "density", "velocity", "force", "mu", "nu", "modulus", "young", "torque"}) {
    const std::string text = unknown_input({}, name), from = text.substr(text.find("key is ") + 7);
    CAPTURE(text);
    CHECK(find_input(from.substr(0, from.find_first_of(",: "))));
  }
}

}  // namespace
