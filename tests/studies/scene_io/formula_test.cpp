#include "studies/scene_io/formula.hpp"

#include <cmath>
#include <limits>

#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"

using namespace rollres;

namespace {

constexpr auto inputs = FormulaNames::inputs;
constexpr auto all = FormulaNames::inputs_and_outputs;

std::string refusal(const std::string& text, FormulaNames names = all) {
  return message_of([&] { Formula(text, names); });
}
std::string refused_condition(const std::string& text) {
  return message_of([&] { Condition(text, all, Indenter::cylinder); });
}

}  // namespace

TEST_CASE("a formula names inputs and outputs by their keys", "[studies][formula]") {
  const RollingScene scene = plain_scene(2.0, 3e4);
  const RollingSolution solution = closed_form(scene);
  const Formula power("rolling_resistance * speed", all);
  CHECK(power(scene, solution) == Approx(solution.rolling_resistance * 2.0).epsilon(1e-15));
  CHECK(power.keys() == std::vector<std::string>{"rolling_resistance", "speed"});
  CHECK(Formula("max(speed, 5)^2 + contact_nodes", all)(scene, solution) == 25 + 31);
  CHECK(Formula("speed > 1 ? 7 : 8", inputs)(scene) == 7);
  CHECK(Formula("1.5e3", inputs)(scene) == 1500);
}

TEST_CASE("a key that is an input and an output stands for the output where there is one", "[studies][formula]") {
  const RollingScene scene = plain_scene(1.0, 3e4);
  RollingSolution solution = closed_form(scene);
  solution.load = 2e4;
  const Formula load("load", all);
  CHECK(load(scene, solution) == 2e4);
  CHECK(load(scene) == 3e4);
}

TEST_CASE("a formula of an absent number has no value, whatever else it says", "[studies][formula]") {
  const RollingScene scene = plain_scene();
  CHECK(std::isnan(Formula("min(approach, 1)", all)(scene)));
  CHECK(std::isnan(Formula("0 > 1 ? approach : 1", all)(scene)));
  RollingScene half_space = scene;
  half_space.layer_thickness = std::numeric_limits<double>::infinity();
  CHECK(Formula("radius / layer_thickness", inputs)(half_space) == 0);
}

TEST_CASE("a formula names the numbers of a list of the answer, by their places", "[studies][formula]") {
  const Formula shear("max(bond_shears[0], bond_shears[1]) / 1e6", FormulaNames::inputs_and_outputs);
  RollingSolution solution;
  CHECK(std::isnan(shear(plain_scene(), solution)));
  solution.bond_shears = {2e6, 5e6};
  CHECK(shear(plain_scene(), solution) == Approx(5));
  CHECK(unit_of(Formula("bond_shears[1]", FormulaNames::inputs_and_outputs), Indenter::cylinder) == "Pa");
  RollingScene scene = plain_scene();
  CHECK(message_of([&] { refuse_absent(Formula("bond_shears[0]", FormulaNames::inputs_and_outputs), scene); }) ==
        "bond_shears[0] is not computed: interior = on computes it");
  scene.interior = Interior::on;
  CHECK(message_of([&] { refuse_absent(Formula("bond_shears[1]", FormulaNames::inputs_and_outputs), scene); }) ==
        "bond_shears[1] is not computed: the scene has 1 layer: [0]");
  CHECK(message_of([] { Formula("bond_shears[0]", FormulaNames::inputs); }) ==
        "bond_shears[0]: bond_shears[0] is an output; here only inputs are known, before a scene is solved");
}

TEST_CASE("a formula that cannot be understood is refused with the nearest key", "[studies][formula]") {
  CHECK(refusal("rolling_resistence * 2") ==
        "rolling_resistence * 2: rolling_resistence: unknown key; did you mean rolling_resistance?");
  CHECK(refusal("rolling_resistance", inputs).find("is an output; here only inputs are known") != std::string::npos);
  CHECK(refusal("speed +").find("speed +: ") == 0);
  CHECK(refusal("speed, load").find("one formula") != std::string::npos);
  CHECK(refusal("").find(": ") != std::string::npos);
  CHECK(refusal("method").find("unknown key") != std::string::npos);
}

TEST_CASE("a formula assigns nothing, and ends where its text ends", "[studies][formula]") {
  for (const char* text : {"load = 3", "(speed=9)*load", "=load", "load ="})
    CHECK(refusal(text).find("== compares") != std::string::npos);
  for (const char* text : {"load == 3", "load >= 3", "load != 3 ? 1 : 2"}) CHECK_NOTHROW(Formula(text, inputs));
  CHECK(refusal(std::string("load\0+1", 7)).find("NUL") != std::string::npos);
  const std::string refused = refusal(std::string(100'000, '(') + "load");
  CHECK(refused.size() < 200);
}

TEST_CASE("a condition compares two formulas, and its right side may have the unit of its left side",
          "[studies][formula]") {
  const RollingScene scene = plain_scene(2.0, 1e4);
  RollingSolution solution = closed_form(scene);
  solution.peak_pressure = 2.5e6;
  solution.approach = 5e-4;
  const Condition pressure("peak_pressure <= 2 MPa", all, Indenter::cylinder);
  CHECK(pressure.excess(scene, solution) == Approx(0.5e6));
  CHECK_FALSE(pressure.holds(scene, solution));
  CHECK(Condition("approach/layer_thickness <= 0.1", all, Indenter::cylinder).holds(scene, solution));
  CHECK(Condition("load >= 10 kN/m", inputs, Indenter::cylinder).holds(scene));
  CHECK_FALSE(Condition("load > 10 kN/m", inputs, Indenter::cylinder).holds(scene));
  CHECK(Condition("speed < 2 * friction_coefficient + 10", inputs, Indenter::cylinder).holds(scene));
  CHECK_FALSE(Condition("viscous_loss < 1", all, Indenter::cylinder).holds(scene, solution));  // absent
}

TEST_CASE("a condition without exactly one comparison is refused", "[studies][formula]") {
  for (const char* text : {"speed", "1 < speed < 2", "speed == 2", "speed = 2", "!speed < 2", ""})
    CHECK(refused_condition(text).find("one of <= < >= >") != std::string::npos);
  CHECK(refused_condition("peak_pressure <= 2 kg") == "2 kg: must have a unit of stress (Pa) for peak_pressure");
  CHECK(refused_condition("speed <= 3 mm") == "3 mm: must have a unit of speed (m/s) for speed");
  CHECK(refused_condition("speed <= 3 * radius").find("unit") == std::string::npos);
}
