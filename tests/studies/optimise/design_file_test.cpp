#include "studies/optimise/design_file.hpp"

#include <cmath>

#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;
using Catch::Matchers::Contains;

namespace {

const std::string scene =
    R"("scene": {"radius": "2 cm", "layer_thickness": "5 mm", "static_shear_modulus": "3 MPa", "stiffening": 1,
                 "creep_time": 0.25, "speed": 0.05, "load": "20 kN/m", "friction_coefficient": 0.2})";

/// A file with these lines after its scene.
std::string text(const std::string& rest) { return "{\"study\": \"layer\", " + scene + ", " + rest + "}"; }

const std::string thickness = R"("variables": {"layer_thickness": {"from": "1 mm", "to": "20 mm"}})";
const std::string goal = R"("minimise": "rolling_resistance")";

DesignProblem read(const std::string& rest) {
  const TemporaryDirectory folder;
  return read_design_problem(folder.write("study.json", text(rest)));
}

std::string refusal(const std::string& rest) {
  return message_of([&] { read(rest); });
}

}  // namespace

TEST_CASE("the study file of an optimisation gives variables, goal, constraints and duty cycle",
          "[studies][optimise]") {
  const DesignProblem problem = read(R"(
    "variables": {"layer_thickness": {"from": "1 mm", "to": "20 mm"},
                  "friction_coefficient": {"from": 0, "to": 0.5, "start": 0.4},
                  "creep_time": {"from": 1, "to": 4, "scale": "linear"}},
    "maximise": "rolling_resistance / load", "constraints": ["peak_pressure <= 2 MPa", "approach <= 1 mm"],
    "scenes": [{"set": {"speed": "1 m/s"}, "weight": 0.3}, {"set": {"approach": "0.1 mm"}}], "over_scenes": "max",
    "algorithm": "slsqp", "global": true, "stop": {"evaluations": 70, "tolerance": 1e-3},
    "pareto": {"minimise": "peak_pressure", "points": 3})");
  CHECK(problem.name == "layer");
  REQUIRE(problem.variables.size() == 3);
  CHECK(problem.variables[0].lowest == 0.001);
  CHECK(problem.variables[0].scaling == Scaling::logarithmic);
  CHECK(problem.variables[1].scaling == Scaling::linear);
  CHECK(problem.variables[2].scaling == Scaling::linear);
  CHECK(problem.start == std::vector<double>{0.005, 0.4, 2.5});  // the scene's, the file's, the middle
  CHECK(problem.goal.maximise);
  REQUIRE(problem.scenes.size() == 2);
  CHECK(problem.scenes[0].weight == 0.3);
  CHECK(problem.scenes[0].scene.speed == 1);
  CHECK(problem.scenes[1].scene.approach == 1e-4);
  CHECK_FALSE(problem.scenes[1].scene.load);
  CHECK(problem.constraints.size() == 2);
  CHECK(problem.goal.over == OverScenes::max);
  CHECK(problem.algorithm == Algorithm::slsqp);
  CHECK(problem.global);
  CHECK(problem.stop.evaluations == 70);
  CHECK(problem.stop.tolerance == 1e-3);
  CHECK(problem.pareto->points == 3);
  CHECK(constraint_name(problem, 2) == "peak_pressure <= 2 MPa, scene 2");
}

TEST_CASE("a variable may be missing in the scene, and takes the place of what it excludes", "[studies][optimise]") {
  const DesignProblem problem =
      read(R"("variables": {"approach": {"from": "0.1 mm", "to": "0.4 mm"}}, "minimise": "peak_pressure")");
  CHECK(problem.start[0] == Approx(2e-4));
  CHECK(problem.scenes[0].scene.approach == problem.start[0]);
  CHECK_FALSE(problem.scenes[0].scene.load);
}

TEST_CASE("what is wrong in the study file of an optimisation is refused with file, key, value and rule",
          "[studies][optimise]") {
  const auto variable = [](const std::string& of) { return "\"variables\": {" + of + "}, " + goal; };
  CHECK_THAT(refusal(goal), Contains("study.json: variables is missing: must be an object with at least one input"));
  CHECK_THAT(refusal(variable("")), Contains("variables = {}: must be an object with at least one input"));
  CHECK_THAT(refusal(variable(R"("layer_thicknes": {"from": 1, "to": 2})")),
             Contains("unknown key; did you mean layer_thickness"));
  CHECK_THAT(refusal(variable(R"("layer_thickness": {"from": "1 mm"})")), Contains("layer_thickness: to is missing"));
  CHECK_THAT(refusal(variable(R"("layer_thickness": {"from": "2 mm", "to": "1 mm"})")),
             Contains("must be larger than \"from\""));
  CHECK_THAT(refusal(variable(R"("layer_thickness": {"from": "2 mm", "to": "infinite"})")),
             Contains("to = \"infinite\": must be finite"));
  CHECK_THAT(refusal(variable(R"("layer_thickness": {"from": "2 mm", "to": "3 s"})")),
             Contains("to: layer_thickness = \"3 s\""));
  CHECK_THAT(refusal(variable(R"("friction_coefficient": {"from": 0, "to": 1, "scale": "logarithmic"})")),
             Contains("scale logarithmic: must be > 0"));
  CHECK_THAT(refusal(variable(R"("layer_thickness": {"from": 0.1, "to": 0.2, "scale": "cubic"})")),
             Contains("scale = \"cubic\": must be one of linear, logarithmic"));
  CHECK_THAT(refusal(variable(R"("layer_thickness": {"from": 0.1, "to": 0.2, "start": 0.3})")),
             Contains("start = 0.3: must be between"));
  CHECK_THAT(refusal(variable(R"("layer_thickness": {"from": 1, "to": 2, "begin": 3})")),
             Contains("begin = 3: unknown key"));
  CHECK_THAT(refusal(variable(R"("method": {"from": 1, "to": 2})")),
             Contains("must be an input that is a real number"));
  CHECK_THAT(refusal(thickness), Contains("there must be a formula under minimise or maximise, and not both"));
  CHECK_THAT(refusal(thickness + ", " + goal + R"(, "maximise": "load")"), Contains("and not both"));
  CHECK_THAT(
      refusal(thickness + R"(, "minimise": "rolling_resistence")"),
      Contains("minimise: rolling_resistence: rolling_resistence: unknown key; did you mean rolling_resistance?"));
  CHECK_THAT(refusal(thickness + R"(, "minimise": "rolling_resistance + approach")"),
             Contains("minimise: rolling_resistance + approach: its terms have different units") &&
                 Contains("2 [kN/m2] * approach"));
  CHECK(refusal(thickness + R"(, "minimise": "rolling_resistance + 2 [kN/m2] * approach")") == "nothing");
  CHECK_THAT(refusal(thickness + R"(, "minimise": "rolling_resistance", "constraints": ["bond_shear <= 1 MPa"])"),
             Contains("constraint 1: bond_shear is not computed: interior = on computes it"));
  const std::string good = thickness + ", " + goal + ", ";
  CHECK_THAT(refusal(good + R"("constraints": ["peak_pressure"])"),
             Contains("constraint 1: peak_pressure: must be two formulas"));
  CHECK_THAT(refusal(good + R"("constraints": "peak_pressure <= 1 Pa")"), Contains("must be a list of conditions"));
  CHECK_THAT(refusal(good + R"("algorithm": "cobila")"), Contains("did you mean cobyla"));
  CHECK_THAT(refusal(good + R"("algorithm": "bobyqa")"),
             Contains("algorithm = \"bobyqa\": needs at least two variables"));
  CHECK_THAT(refusal(good + R"("global": 1)"), Contains("global = 1: must be true or false"));
  CHECK_THAT(refusal(good + R"("stop": {"evaluations": 0})"),
             Contains("stop: evaluations = 0: must be a whole number"));
  CHECK_THAT(refusal(good + R"("stop": {"tolerance": 1})"),
             Contains("tolerance = 1: must be a number from 1e-8 to 0.1"));
  CHECK_THAT(refusal(good + R"("stop": {"seconds": 1})"), Contains("seconds = 1: unknown key"));
  CHECK_THAT(refusal(good + R"("scenes": [])"), Contains("must be a list of objects with set and weight"));
  CHECK_THAT(refusal(good + R"("scenes": [{"weight": 0}])"), Contains("scene 1: weight = 0: must be a number > 0"));
  CHECK_THAT(refusal(good + R"("scenes": [{"set": {"layer_thickness": 1}}])"),
             Contains("scene 1: set: layer_thickness = 1: is a variable too"));
  CHECK_THAT(refusal(good + R"("scenes": [{"set": {"indenter": "sphere"}}])"),
             Contains("must be the same in all scenes"));
  CHECK_THAT(refusal(good + R"("over_scenes": "median")"), Contains("must be one of sum, mean, max, min"));
  CHECK_THAT(refusal(good + R"("pareto": {"minimise": "load"})"), Contains("pareto: points is missing"));
  CHECK_THAT(refusal(good + R"("pareto": {"points": 3})"), Contains("pareto: minimise: there must be a formula"));
  CHECK_THAT(refusal(good + R"("axes": {})"),
             Contains("axes = {}: a study has axes; a design has variables in their place"));
  CHECK_THAT(refusal(good + R"("set": {"layer_thickness": 1})"), Contains("set: layer_thickness = 1"));
}
