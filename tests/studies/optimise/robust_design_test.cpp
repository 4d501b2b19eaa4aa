#include <cmath>
#include <fstream>

#include "studies/optimise/design_file.hpp"
#include "studies/optimise/optimise.hpp"
#include "studies/optimise/optimise_report.hpp"
#include "studies/optimise/stored_optimum.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/source_directory.hpp"
#include "tests/studies/design_bowl.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;
using Catch::Matchers::Contains;

namespace {

/// The standard normal number behind a friction of 0.3 +- 0.03.
double z(const RollingScene& scene) { return (scene.friction_coefficient - 0.3) / 0.03; }

/// R = 2 + (V - 1)^2 + 0.2 V z, p = V (1 + 0.1 z).
RollingSolution scattering(const RollingScene& scene) {
  RollingSolution solution = closed_form(scene);
  const double v = scene.speed;
  solution.rolling_resistance = 2 + (v - 1) * (v - 1) + 0.2 * v * z(scene);
  solution.peak_pressure = v * (1 + 0.1 * z(scene));
  return solution;
}

const std::string scene_text =
    R"("scene": {"radius": "2 cm", "layer_thickness": "5 mm", "layer_density": 1000, "static_shear_modulus": "3 MPa",
                 "stiffening": 1, "creep_time": 0.25, "speed": 0.8, "load": "20 kN/m", "friction_coefficient": 0.3})";
const std::string speeds = R"("variables": {"speed": {"from": 0.5, "to": 2, "scale": "linear"}})";
const std::string friction = R"("uncertain": {"friction_coefficient": {"normal": [0.3, "10 %"]}, "points": 256})";

std::string robust_text(const std::string& rest) { return R"({"study": "robust", )" + scene_text + ", " + rest + "}"; }

DesignProblem robust(const std::string& rest) {
  const TemporaryDirectory folder;
  return read_design_problem(folder.write("study.json", robust_text(rest)));
}

Design best_of(const DesignProblem& problem, const Evaluate& evaluate = scattering) {
  StoredEvaluations evaluations(evaluate);
  const OptimiseReport report = optimise(problem, evaluations, {.jobs = 1});
  CAPTURE(report.reason);
  CHECK(report.status == DesignStatus::optimum);
  return report.best.value();
}

constexpr double z90 = 1.2815515655446004, z95 = 1.6448536269514722;  // normal quantiles

}  // namespace

TEST_CASE("the optimum of a mean and of what scatters about it is that of the closed form", "[studies][optimise]") {
  // mean + k sd = 2 + (V - 1)^2 + 0.2 k V is least at V = 1 - 0.1 k; 256 points of low discrepancy know sd to 1 %
  const auto goal = [](const std::string& scatter) {
    return speeds + ", " + friction + R"(, "minimise": {"formula": "rolling_resistance", "scatter": ")" + scatter +
           "\"}";
  };
  CHECK(best_of(robust(goal("mean"))).point[0] == Approx(1).margin(2e-3));
  CHECK(best_of(robust(goal("mean + 2 sd"))).point[0] == Approx(0.8).margin(4e-3));
  CHECK(best_of(robust(goal("mean - 2 sd"))).point[0] == Approx(1.2).margin(4e-3));
  CHECK(best_of(robust(goal("P90"))).point[0] == Approx(1 - 0.1 * z90).margin(4e-3));
  const Design design = best_of(robust(goal("mean + 2 sd")));
  CHECK(design.value == Approx(2 + 0.04 + 0.32).margin(5e-3));
  CHECK(design.keys.size() == 256);
}

TEST_CASE("a limit holds for the quantile that it names", "[studies][optimise]") {
  const Design design = best_of(
      robust(speeds + ", " + friction +
             R"(, "maximise": "speed", "constraints": [{"condition": "peak_pressure <= 1 Pa", "scatter": "P95"}])"));
  CHECK(design.point[0] == Approx(1 / (1 + 0.1 * z95)).margin(2e-3));
  REQUIRE(design.constraints.size() == 1);
  CHECK(design.constraints[0].left == Approx(1).margin(1e-3));
}

TEST_CASE("a variable scatters about its value", "[studies][optimise]") {
  // (H (1 + 0.1 z) - 8 mm)^2 has the mean (H - 8 mm)^2 + (0.1 H)^2, which is least at H = 8 mm / 1.01
  const DesignProblem problem = robust(
      R"("variables": {"layer_thickness": {"from": "2 mm", "to": "20 mm"}}, "minimise": "rolling_resistance",
         "uncertain": {"layer_thickness": {"normal": "10 %"}, "points": 128})");
  const auto evaluate = [](const RollingScene& scene) {
    RollingSolution solution = closed_form(scene);
    const double apart = scene.layer_thickness / 1e-3 - 8;
    solution.rolling_resistance = 1 + apart * apart;
    return solution;
  };
  CHECK(best_of(problem, evaluate).point[0] == Approx(8e-3 / 1.01).epsilon(3e-3));

  // Its designs are read back from what is stored.
  const TemporaryDirectory folder;
  const auto study = folder.write(
      "study.json",
      robust_text(
          R"("variables": {"layer_thickness": {"from": "2 mm", "to": "20 mm"}}, "minimise": "rolling_resistance",
         "uncertain": {"layer_thickness": {"normal": "10 %"}, "points": 16}, "stop": {"evaluations": 400})"));
  const std::string database = (folder.path / "results.db").string();
  run_rollres({"optimise", study.string(), "--db", database}, evaluate);
  ResultStore store(database, Access::read);
  const auto stored = stored_optimum(store, "robust");
  REQUIRE(stored);
  REQUIRE(stored->best);
  CHECK(stored->best->point[0] == Approx(8e-3 / 1.01).epsilon(0.02));
  CHECK(stored->designs.size() > 5);
}

TEST_CASE("a goal and a limit say over which number of the scenes they are", "[studies][optimise]") {
  const std::string scenes = speeds + R"(, "scenes": [{"set": {"load": 1e4}, "weight": 0.3}, {"set": {"load": 2e4}}])";
  const auto value = [&](const std::string& rest) {
    const DesignProblem problem = robust(scenes + ", " + rest);
    return evaluate_design(problem, problem.start, [](const RollingScene& scene) {
      RollingSolution solution = closed_form(scene);
      solution.rolling_resistance = *scene.load;
      return solution;
    });
  };
  CHECK(value(R"("minimise": "rolling_resistance")").value == Approx(0.3 * 1e4 + 2e4));
  CHECK(value(R"("minimise": {"formula": "rolling_resistance", "over": "mean"})").value ==
        Approx((0.3 * 1e4 + 2e4) / 1.3));
  CHECK(value(R"("minimise": {"formula": "rolling_resistance", "over": "max"})").value == 2e4);
  CHECK(value(R"("over_scenes": "min", "minimise": "rolling_resistance")").value == 1e4);
  const std::string limited = R"("minimise": "rolling_resistance", "constraints": ["rolling_resistance <= 15 kN/m",
      {"condition": "rolling_resistance <= 15 kN/m", "over": "min"}])";
  const Design design = value(limited);
  REQUIRE(design.constraints.size() == 3);
  CHECK(design.constraints[0].holds);
  CHECK_FALSE(design.constraints[1].holds);
  CHECK(design.constraints[2].holds);
  const DesignProblem problem = robust(scenes + ", " + limited);
  CHECK(constraint_name(problem, 1) == "rolling_resistance <= 15 kN/m, scene 2");
  CHECK(constraint_name(problem, 2) == "rolling_resistance <= 15 kN/m, min over 2 scenes");
  CHECK(measure_in_words(problem, problem.goal) == ", weighted sum over 2 scenes");
}

TEST_CASE("a robust design is told with what it is the best of", "[studies][optimise]") {
  const TemporaryDirectory folder;
  const auto study = folder.write(
      "study.json",
      robust_text(speeds + ", " + friction + R"(, "minimise": {"formula": "rolling_resistance", "scatter": "P90"})"));
  const ProgramRun run =
      run_rollres({"optimise", study.string(), "--db", (folder.path / "results.db").string()}, scattering);
  CHECK(run.status == 0);
  CHECK_THAT(run.out, Contains("minimise rolling_resistance, P90 of 256 points: "));
}

TEST_CASE("goals that do not conflict are said to be so, and no column stands twice", "[studies][optimise]") {
  const TemporaryDirectory folder;
  const std::string database = (folder.path / "results.db").string();
  const auto print = [&](const std::string& name, const std::string& second) {
    const auto study =
        folder.write(name + ".json", R"({"study": ")" + name + R"(", )" + scene_text + ", " + speeds +
                                         R"(, "minimise": "rolling_resistance", "pareto": )" + second + "}");
    return run_rollres({"optimise", study.string(), "--db", database}, scattering).out;
  };
  CHECK_THAT(print("alike", R"({"minimise": "rolling_resistance * speed ^ 0", "points": 5})"),
             Contains("the goals do not conflict: one design is the best for both"));
  const std::string apart = print("apart", R"({"minimise": "speed", "points": 3})");
  CHECK_THAT(apart, !Contains("do not conflict"));
  CHECK_THAT(apart, Contains("\nfront  rolling_resistance  speed"));
  CHECK(apart.find("speed", apart.find("\nfront  rolling_resistance  speed") + 32) == std::string::npos);
}

TEST_CASE("a robust problem that leaves something open is refused", "[studies][optimise]") {
  const auto refusal_of = [](const std::string& rest) { return message_of([&] { robust(speeds + ", " + rest); }); };
  const std::string goal = R"(, "minimise": "rolling_resistance")";
  CHECK_THAT(refusal_of(friction + goal + R"(, "constraints": ["peak_pressure <= 1 Pa"])"),
             Contains("what of the scatter must hold it?"));
  CHECK_THAT(refusal_of(friction + goal +
                        R"(, "constraints": [{"condition": "approach <= 0.1 * layer_thickness", "scatter": "P95"}])"),
             Contains("its right side must be a number: divide by what stands there"));
  CHECK_THAT(refusal_of(R"("minimise": {"formula": "rolling_resistance", "scatter": "P90"})"),
             Contains("scatter = \"P90\": needs \"uncertain\": no input scatters"));
  CHECK_THAT(refusal_of(friction + R"(, "minimise": {"formula": "rolling_resistance", "scatter": "often"})"),
             Contains("minimise: scatter: often: must be \"mean\""));
  CHECK_THAT(refusal_of(R"("uncertain": {"speed": {"normal": [1, 0.1]}})" + goal),
             Contains("is a variable: it scatters about its value, by shares as in \"10 %\""));
  const auto bounds = [&](const std::string& variable, const std::string& uncertain) {
    return message_of([&] {
      robust(R"("variables": {)" + variable + R"(}, "uncertain": {)" + uncertain + R"(}, "minimise": "speed")");
    });
  };
  CHECK_THAT(
      bounds(R"("friction_coefficient": {"from": 0, "to": 0.5})", R"("friction_coefficient": {"normal": "5 %"})"),
      Contains("at 0: what scatters by shares must be > 0 and finite"));
  CHECK_THAT(bounds(R"("poisson_ratio": {"from": 0.3, "to": 0.499})", R"("poisson_ratio": {"normal": "5 %"})"),
             Contains("has weight outside its range (must be from 0 to 0.5)"));
  CHECK(bounds(R"("poisson_ratio": {"from": 0.3, "to": 0.499})",
               R"("poisson_ratio": {"normal": "5 %", "truncated": true})") == "nothing");
  CHECK_THAT(refusal_of(R"("uncertain": {"load": {"normal": "5 %"}, "probability": ["approach > 1 mm"]})" + goal),
             Contains("is for rollres scatter"));
}

TEST_CASE("the example of a robust design is understood, each goal by its scatter", "[studies][optimise]") {
  const DesignProblem problem = read_design_problem(source_directory() / "studies" / "examples" / "robust_layer.json");
  CHECK(problem.scenes_of_a_design() == 32);
  const Design design = evaluate_design(problem, problem.start, Bowl::solve);
  REQUIRE(design.found());
  CHECK(design.constraints.size() == 1);
  CHECK(design.keys.size() == 32);
}
