#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/source_directory.hpp"
#include "tests/studies/program.hpp"

// Covers gradient_report, too.

using namespace rollres;
using nlohmann::json;

namespace {

ProgramRun run_gradient(std::vector<std::string> words, const Evaluate& evaluate = closed_form) {
  words.insert(words.begin(), {"gradient", example("paper_cylinder.json")});
  return run_rollres(words, evaluate);
}

}  // namespace

TEST_CASE("gradient prints derivatives, elasticities, errors and units", "[studies][gradient]") {
  const ProgramRun text = run_gradient({"--inputs", "load,speed,creep_time"});
  CHECK(text.status == 0);
  CHECK(text.err.empty());
  CHECK_THAT(text.out, Catch::StartsWith("rolling_resistance = 9.9751 N/m, ") && Catch::Contains("\nload ") &&
                           Catch::Contains("20 kN/m") && Catch::Contains("N/m / (N/m)") && Catch::Contains("N/m / s") &&
                           Catch::Contains("logarithmic"));

  const ProgramRun object = run_gradient({"--inputs", "load,speed", "--set", "speed=2 m/s", "--json", "--jobs", "2"});
  CHECK(object.status == 0);
  const json answer = json::parse(object.out);
  CHECK(answer["output"] == "rolling_resistance");
  CHECK(answer["value"].get<double>() == Approx(80));
  REQUIRE(answer["inputs"].size() == 2);
  const json& load = answer["inputs"][0];
  CHECK(load["key"] == "load");
  CHECK(load["derivative"].get<double>() == Approx(0.004).epsilon(1e-10));
  CHECK(load["derivative_unit"] == "N/m / (N/m)");
  CHECK(load["highest"].is_null());
  CHECK(load["scale"] == "logarithmic");
  CHECK(load["scheme"] == "central");
  const json& speed = answer["inputs"][1];
  CHECK(speed["elasticity"].get<double>() == Approx(-0.6).epsilon(1e-10));
  CHECK(std::abs(speed["elasticity"].get<double>() + 0.6) <= speed["elasticity_error"].get<double>());
  CHECK(answer["evaluations"] == 1 + load["evaluations"].get<int>() + speed["evaluations"].get<int>());
}

TEST_CASE("gradient differentiates any output that is a real number", "[studies][gradient]") {
  const json answer = json::parse(
      run_gradient({"--inputs", "speed", "--output", "rolling_resistance_coefficient", "--order", "2", "--json"}).out);
  CHECK(answer["unit"] == "1");
  CHECK(answer["inputs"][0]["derivative_unit"] == "1 / (m/s)");
  const double v = 0.05, square = 1 + v * v;
  CHECK(answer["inputs"][0]["derivative"].get<double>() ==
        Approx(0.01 * (1 - v * v) / (square * square)).epsilon(1e-8));
}

TEST_CASE("gradient of a scene without an answer ends with exit status 1 and the reason", "[studies][gradient]") {
  const Evaluate none = [](const RollingScene&) {
    RollingSolution solution;
    solution.status = Status::no_steady_state;
    solution.reason = "needs more friction";
    return solution;
  };
  const ProgramRun text = run_gradient({"--inputs", "load"}, none);
  CHECK(text.status == 1);
  CHECK(text.out == "status   no_steady_state\nreason   needs more friction\n");
  const ProgramRun object = run_gradient({"--inputs", "load", "--json"}, none);
  CHECK(object.status == 1);
  CHECK(json::parse(object.out)["status"] == "no_steady_state");
  CHECK(json::parse(object.out)["inputs"].empty());
}

TEST_CASE("gradient reports the points where a step found no answer", "[studies][gradient]") {
  const Evaluate cliff = [](const RollingScene& scene) {
    RollingSolution solution = closed_form(scene);
    if (scene.speed > 0.0501) {
      solution.status = Status::not_converged;
      solution.reason = "too fast";
    }
    return solution;
  };
  const ProgramRun text = run_gradient({"--inputs", "load,speed"}, cliff);
  CHECK(text.status == 0);
  CHECK_THAT(text.err, Catch::StartsWith("speed: ") && Catch::Contains("too fast"));
  const json answer = json::parse(run_gradient({"--inputs", "speed", "--json"}, cliff).out);
  CHECK(answer["inputs"][0]["failures"][0]["status"] == "not_converged");
}

TEST_CASE("wrong words after gradient end with exit status 2 and one line", "[studies][gradient]") {
  const std::vector<std::pair<std::vector<std::string>, std::string>> commands{
      {{}, "--inputs"},
      {{"--inputs", "laod"},
       example("paper_cylinder.json") + " with --inputs: laod: unknown input; did you mean load?"},
      {{"--inputs", "approach"}, "approach: must be in the scene to be varied"},
      {{"--inputs", "load,load"}, "load: input given twice"},
      {{"--inputs", "method"}, "method: must be an input that is a real number"},
      {{"--inputs", "load", "--output", "rolling"}, "--output: rolling: unknown output"},
      {{"--inputs", "load", "--output", "half_width"}, "--output: half_width is not computed: "},
      {{"--inputs", "load", "--output", "bond_shear"},
       "--output: bond_shear is not computed: interior = on computes it"},
      {{"--inputs", "load", "--order", "3"}, "--order"},
      {{"--inputs", "load", "--jobs", "0"}, "--jobs"},
      {{"--inputs", "load", "--set", "speed=0"}, "--set: speed = 0: must be > 0"}};
  for (const auto& [words, message] : commands) {
    const ProgramRun run = run_gradient(words);
    CAPTURE(words);
    CHECK(run.status == 2);
    CHECK(run.out.empty());
    CHECK_THAT(run.err, Catch::StartsWith("rollres: ") && Catch::Contains(message));
    CHECK(run.err.find('\n') == run.err.size() - 1);
  }
  CHECK(run_rollres({"gradient", "/nowhere.json", "--inputs", "load"}, closed_form).status == 3);
  CHECK_THAT(run_rollres({"gradient", "--help"}, closed_form).out, Catch::Contains("Example: rollres gradient"));
}
