#include "studies/scene_io/dimension.hpp"

#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"

using namespace rollres;
using Catch::Matchers::Contains;

namespace {

std::string unit_of_text(const std::string& text, Indenter indenter = Indenter::cylinder) {
  return unit_of_value(Formula(text, FormulaNames::inputs_and_outputs), indenter).value_or("does not fit");
}

}  // namespace

TEST_CASE("a formula's unit follows from those of its numbers", "[studies][formula][dimension]") {
  CHECK(unit_of_text("speed * creep_time / radius") == "1");
  CHECK(unit_of_text("speed * creep_time") == "m");
  CHECK(unit_of_text("rolling_resistance * speed") == "W/m");
  CHECK(unit_of_text("rolling_resistance * speed", Indenter::sphere) == "W");
  CHECK(unit_of_text("sqrt(static_shear_modulus / layer_density)") == "m/s");
  CHECK(unit_of_text("layer_density * speed^2 + static_shear_modulus") == "Pa");
  CHECK(unit_of_text("load / (radius * static_shear_modulus)") == "1");
  CHECK(unit_of_text("max(leading_edge, -trailing_edge)") == "m");
  CHECK(unit_of_text("speed > 2 * radius / creep_time ? load : 3 * load") == "N/m");
  CHECK(unit_of_text("wlf_c1 * (temperature - reference_temperature) / (wlf_c2 + temperature)") == "1");
  CHECK(unit_of_text("activation_energy / temperature") == "m2.kg.s-2.K-1.mol-1");
  CHECK(unit_of_text("creep_time^0.5") == "s0.5");
  CHECK(unit_of_text("2 + 3") == "1");
  CHECK(unit_of_text("speed < 2 ? 0.3 : 0.7") == "1");  // compared in SI
  CHECK(unit_of_text("load > 1 ? speed : 2 * radius / creep_time") == "m/s");
  CHECK(unit_of_text("exp(-speed * creep_time / radius)") == "1");
  CHECK(unit_of_text("rotation_speed * radius / speed") == "1");
  CHECK(unit_of_text("load", Indenter::sphere) == "N");
}

TEST_CASE("terms that do not fit are found, also where only a function or a power shows them",
          "[studies][formula][dimension]") {
  for (const char* const text : {"speed + load", "speed + 1", "exp(speed)", "max(speed, load)",
                                 "radius^friction_coefficient", "peak_pressure - 2e6", "rolling_resistance + approach",
                                 "speed < 1 ? speed : load", "radius / speed + creep_time^2", "ln(load)"}) {
    CAPTURE(text);
    CHECK(unit_of_text(text) == "does not fit");
  }
  CHECK(unit_of_text("sqrt(0 - speed)") == "");  // has no value anywhere
  CHECK(units_in(Formula("rolling_resistance + approach", FormulaNames::inputs_and_outputs), Indenter::cylinder) ==
        "rolling_resistance [N/m], approach [m]");
}

TEST_CASE("a number has a unit in brackets, and then terms fit that did not", "[studies][formula][dimension]") {
  CHECK(unit_of_text("rolling_resistance + 2 [kN/m2] * approach") == "N/m");
  CHECK(unit_of_text("rolling_resistance + 2[Pa] * approach", Indenter::sphere) == "does not fit");
  CHECK(unit_of_text("max(speed, 3.6 [km/h])") == "m/s");
  CHECK(unit_of_text("rolling_resistance + 1e12 * approach") == "does not fit");  // however small a term is
  RollingScene scene;
  scene.radius = 0.5;
  const auto value = [&](const char* text) { return Formula(text, FormulaNames::inputs)(scene); };
  CHECK(value("radius + 20 [cm]") == Approx(0.7));
  CHECK(value("radius * 1.5e-1 [kN/mm2]") == Approx(0.5 * 1.5e8));
  CHECK(value("2 [rad] * 3") == Approx(6));
  const auto refusal = [](const char* text) { return message_of([&] { Formula(text, FormulaNames::inputs); }); };
  CHECK_THAT(refusal("radius + 2 [parrots]"), Contains("parrots: must be a unit, as in kN/m2"));
  CHECK_THAT(refusal("radius + 2 [mm"), Contains("a [ has no ]"));
  CHECK_THAT(refusal("radius + 2 [degC]"), Contains("degC: must be a unit"));
  CHECK_THAT(message_of([] { Condition("speed + load <= 3", FormulaNames::inputs, Indenter::cylinder); }),
             Contains("speed + load: its terms have different units") && Contains("speed [m/s], load [N/m]") &&
                 Contains("2 [kN/m2] * approach"));
  const Condition limit("speed * 2 <= 1 [m/s] + 36 [km/h]", FormulaNames::inputs, Indenter::cylinder);
  scene.speed = 5.4;
  CHECK(limit.holds(scene));
  scene.speed = 5.6;
  CHECK_FALSE(limit.holds(scene));
}

TEST_CASE("a definition stands for its formula, in brackets, and only where its whole name stands",
          "[studies][formula]") {
  const FormulaDefinitions names{{"a", "speed + 1"}, {"b2", "radius"}};
  CHECK(with_definitions("2*a/b2 - a2 + max(a,1e-3)", names) == "2*(speed + 1)/(radius) - a2 + max((speed + 1),1e-3)");
  CHECK(with_definitions("", names) == "");
  CHECK(with_definitions(" a ", names) == " (speed + 1) ");
}

TEST_CASE("energy is sold by the kilowatt hour, and money is a unit of its own", "[studies][formula]") {
  const auto unit = [](const std::string& text) {
    return unit_of_value(Formula(text, FormulaNames::inputs_and_outputs), Indenter::sphere);
  };
  const Formula cost("rolling_resistance * 1000 [km] * 0.3 [EUR/kWh]", FormulaNames::inputs_and_outputs);
  CHECK(unit(cost.text()) == "EUR");
  RollingSolution solution;
  solution.rolling_resistance = 3.6;
  CHECK(cost(RollingScene(), solution) == Approx(0.3));  // 3.6 MJ are one kWh
  CHECK(unit("rolling_resistance * speed * 1 [year] / 1 [kWh]") == "1");
  CHECK(unit("2 [EUR] + 3 [€]") == "EUR");
  CHECK_FALSE(unit("2 [EUR/m] * radius + 3 [USD]"));
  CHECK_FALSE(unit("2 [EUR/m] * radius + 3"));
  CHECK(unit("5 [CHF/m] * radius + 100 [CHF]") == "CHF");
}

TEST_CASE("formulas know pi", "[studies][formula]") {
  RollingScene scene;
  scene.radius = 0.5;
  CHECK(Formula("2 * pi * radius", FormulaNames::inputs)(scene) == Approx(3.14159265358979));
  CHECK(unit_of_value(Formula("pi * radius ^ 2", FormulaNames::inputs), Indenter::sphere) == "m2");
}
