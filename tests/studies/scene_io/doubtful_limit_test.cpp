#include "studies/scene_io/doubtful_number.hpp"

#include <nlohmann/json.hpp>

#include "studies/optimise/design_file.hpp"
#include "studies/scene_io/formula.hpp"
#include "studies/study/study.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

std::string refusal_of_condition(const std::string& text, Body body = Indenter::cylinder) {
  return message_of([&] { Condition(text, FormulaNames::inputs_and_outputs, body); });
}

std::string refusal_of_formula(const std::string& text) {
  return message_of([&] { refuse_doubtful_limits(text, Indenter::cylinder); });
}

json rolling_scene() {
  return {{"radius", 0.1},   {"layer_thickness", 0.01}, {"static_shear_modulus", 1e6},
          {"stiffening", 2}, {"creep_time", 0.1},       {"speed", 1},
          {"load", 2e4}};
}

}  // namespace

TEST_CASE("a limit without a unit that looks like mm, MPa or degC is refused, with one it holds",
          "[studies][scene_io]") {
  CHECK(refusal_of_condition("layer_thickness <= 6") ==
        "layer_thickness: limit 6: did you mean 6 [mm]? A number without a unit is in m: write 6 [m] if that is meant");
  CHECK_THAT(refusal_of_condition("3 > approach"), Contains("approach: limit 3: did you mean 3 [mm]?"));
  CHECK_THAT(refusal_of_condition("approach + layer_thickness < 20"), Contains("did you mean 20 [mm]?"));
  CHECK_THAT(refusal_of_condition("diameter >= 50"), Contains("did you mean 50 [mm]?"));
  CHECK_THAT(refusal_of_condition("peak_pressure <= 2"), Contains("did you mean 2 [MPa]?"));
  CHECK_THAT(refusal_of_condition("bond_shears[1] <= 0.7"), Contains("did you mean 0.7 [MPa]?"));
  CHECK_THAT(refusal_of_condition("coating_layers[0].static_shear_modulus > 3"), Contains("did you mean 3 [MPa]?"));
  CHECK_THAT(refusal_of_condition("temperature <= 40"),
             Contains("did you mean 40 degC, which is 313.15 [K]?") && Contains("write 40 [K] if that is meant"));
  for (const char* const good :
       {"layer_thickness <= 6 mm", "layer_thickness <= 6 [mm]", "layer_thickness <= 6 m", "layer_thickness <= 6 [m]",
        "layer_thickness <= 0.006", "peak_pressure <= 2 MPa", "peak_pressure <= 2e6", "bond_tension <= 0",
        "temperature <= 313.15", "temperature <= 40 degC", "temperature <= 40 K", "load <= 3", "speed < 5",
        "approach / layer_thickness <= 1.5", "layer_thickness > 6 * approach", "static_shear_modulus > 1e3"})
    CHECK((good + refusal_of_condition(good)) == good + std::string("nothing"));
  // A cylinder's area of contact is a length per metre, that of a sphere an area.
  CHECK_THAT(refusal_of_condition("contact_area <= 20"), Contains("did you mean 20 [mm]?"));
  CHECK(refusal_of_condition("contact_area <= 20", Indenter::sphere) == "nothing");
}

TEST_CASE("a limit inside a formula is refused as that of a condition is", "[studies][scene_io]") {
  CHECK(refusal_of_formula("layer_thickness < 6 ? 1 : 2") ==
        "layer_thickness < 6: did you mean 6 [mm]? A number without a unit is in m: write 6 [m] if that is meant");
  CHECK_THAT(refusal_of_formula("2 * (6 >= layer_thickness && speed > 3 ? 1 : 2)"), Contains("6 >= layer_thickness"));
  CHECK_THAT(refusal_of_formula("speed > 1 || peak_pressure==5 ? 1 : 2"), Contains("peak_pressure == 5: did you mean"));
  for (const char* const good :
       {"layer_thickness < 6 [mm] ? 1 : 2", "layer_thickness < 6 * approach ? 1 : 2", "layer_thickness * 2 < 6 ? 1 : 2",
        "speed < 2 ? 0.3 : 0.7", "max(layer_thickness, 6)", "6 < 7 ? 1 : 2", "6 [m] > layer_thickness ? 1 : 2",
        "unheard_of < 6 ? 1 : 2", "<", "layer_thickness <", ""})
    CHECK((good + refusal_of_formula(good)) == good + std::string("nothing"));
}

TEST_CASE("limits are refused wherever a study or an optimisation has one", "[studies][study][optimise]") {
  const TemporaryDirectory folder;
  const auto refusal = [&](json study) {
    study.update({{"study", "s"}, {"scene", rolling_scene()}});
    const auto file = folder.write("study.json", study.dump());
    return message_of([&] { study.contains("variables") ? void(read_design_problem(file)) : void(read_study(file)); });
  };
  const json axes{{"speed", {1, 2}}};
  CHECK_THAT(refusal({{"axes", axes}, {"constraints", {"layer_thickness <= 6"}}}),
             Contains("constraint 1: layer_thickness: limit 6: did you mean 6 [mm]?"));
  CHECK_THAT(refusal({{"axes", axes}, {"compute", {{{"cost", "layer_thickness < 6 ? 1 : 2"}}}}}),
             Contains("compute: cost: layer_thickness < 6: did you mean 6 [mm]?"));
  CHECK_THAT(refusal({{"uncertain", {{"load", {{"normal", {2e4, 1e3}}}}, {"probability", {"peak_pressure > 3"}}}}}),
             Contains("probability: peak_pressure: limit 3: did you mean 3 [MPa]?"));
  const json thickness{{"layer_thickness", {{"from", "2 mm"}, {"to", "20 mm"}}}};
  CHECK_THAT(refusal({{"variables", thickness}, {"minimise", "peak_pressure"}, {"constraints", {"approach <= 1.5"}}}),
             Contains("constraint 1: approach: limit 1.5: did you mean 1.5 [mm]?"));
  CHECK_THAT(refusal({{"variables", thickness}, {"minimise", "layer_thickness < 6 ? 1 : 2"}}),
             Contains("minimise: layer_thickness < 6: did you mean 6 [mm]?"));
}
