#include "studies/charts/study_chart.hpp"

#include <cmath>
#include <stdexcept>

#include "studies/optimise/stored_optimum.hpp"
#include "studies/run/sweep.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"

// Covers map_chart and figure_data, too.

using namespace rollres;
using Catch::Matchers::Contains;

namespace {

constexpr double speeds[] = {0.01, 0.1, 1, 10, 100}, loads[] = {1e4, 2e4, 3e4};

/// A peak at 1 m/s and 20 kN/m.
RollingSolution hill(const RollingScene& scene) {
  RollingSolution solution = closed_form(scene);
  const double from_peak = std::log10(scene.speed), load = *scene.load / 1e4 - 2;
  solution.rolling_resistance = 200 - 20 * from_peak * from_peak - 30 * load * load;
  return solution;
}

Study grid() {
  return {.name = "grid",
          .base = plain_scene(),
          .axes = {{.key = "load", .values = {std::begin(loads), std::end(loads)}},
                   {.key = "speed", .values = {std::begin(speeds), std::end(speeds)}, .logarithmic = true}}};
}

std::string stored_grid(const TemporaryDirectory& scratch, const Study& study, const Evaluate& evaluate = hill) {
  run_sweep(study, evaluate, scratch / "results.db");
  return (scratch / "results.db").string();
}

}  // namespace

TEST_CASE("a map has a study's two longest axes, and marks the peak inside", "[studies][chart]") {
  const TemporaryDirectory scratch;
  ResultStore store(stored_grid(scratch, grid()), Access::read);
  const StoredMap map = stored_map(store, {});
  const MapRequest& request = map.request;
  CHECK(map.points == 15);
  CHECK(map.unanswered == 0);
  CHECK(request.x.name == "speed");
  CHECK(request.x.logarithmic);
  CHECK(request.y.name == "load");
  CHECK(request.y.unit == "kN/m");
  CHECK_FALSE(request.y.logarithmic);
  REQUIRE(request.field.values.size() == 15);
  CHECK(request.field.y == std::vector<double>{10, 20, 30});
  CHECK(request.field.at(2, 1) == Approx(200));
  CHECK(request.field.at(0, 0) == Approx(200 - 80 - 30));
  CHECK(map_peak(request) == 7);
  const StoredMap turned = stored_map(store, {.x = "load", .map = "approach"});
  CHECK(turned.request.y.name == "speed");
}

TEST_CASE("a map is blank around a point without an answer and marks it, and grey where there is no steady state",
          "[studies][chart]") {
  const TemporaryDirectory scratch;
  const Evaluate failing = [](const RollingScene& scene) {
    if (scene.speed == 1 && *scene.load == 2e4) throw std::runtime_error("no");
    RollingSolution solution = hill(scene);
    if (scene.speed == 100) solution.status = Status::not_converged;
    if (scene.speed == 0.01) {
      solution = {};
      solution.status = Status::no_steady_state;
    }
    return solution;
  };
  const std::string file = stored_grid(scratch, grid(), failing);
  ResultStore store(file, Access::read);
  const MapRequest request = stored_map(store, {}).request;
  CHECK(request.nodes[7] == MapNode::unanswered);
  CHECK(request.nodes[4] == MapNode::not_converged);
  CHECK(request.nodes[5] == MapNode::no_steady_state);
  CHECK(std::isnan(request.field.values[7]));
  CHECK(std::isnan(request.field.values[4]));
  const ProgramRun run = run_rollres(
      {"chart", "--db", file, "--map", "rolling_resistance", "--out", (scratch / "map").string()}, closed_form);
  CHECK(run.status == 0);
  CHECK_THAT(run.err, Contains("7 of 15 points have no answer"));
  CHECK_THAT(file_text(scratch / "map.svg"),
             Contains("no answer") && Contains("not converged") && Contains("no steady state"));
}

TEST_CASE("a study file asks for a map as for any chart", "[studies][chart]") {
  const TemporaryDirectory scratch;
  const std::string file = (scratch / "results.db").string();
  const auto study = [&](const std::string& chart) {
    return scratch
        .write("study.json", R"({"study": "mapped", "scene": {"radius": 0.1, "layer_thickness": 0.01,
      "static_shear_modulus": 1e6, "material": "elastic"}, "axes": {"speed": [0.1, 1, 10], "load": [1e4, 2e4, 3e4]},
      "charts": [{"x": "speed"}, )" +
                                 chart + "]}")
        .string();
  };
  const auto sweep = [&](const std::string& chart) { return run_rollres({"sweep", study(chart), "--db", file}, hill); };
  REQUIRE(sweep(R"({"name": "hill", "map": "rolling_resistance", "x": "load", "y": "speed"})").status == 0);
  const ProgramRun all = run_rollres({"chart", "--db", file, "--chart", "all"}, hill);
  CHECK(all.err.empty());
  CHECK_THAT(all.out, Contains("largest of the points: rolling resistance 200 N/m at load 20 kN/m, speed 1 m/s\n"));
  CHECK_THAT(file_text(scratch / "mapped_hill.svg"), Contains("peak 200 N/m"));
  const ProgramRun curves = run_rollres({"chart", "--db", file, "--chart", "hill", "--x", "speed"}, hill);
  CHECK(curves.status == 0);
  CHECK_THAT(curves.out, Contains("mapped_hill_speed.svg"));

  CHECK_THAT(sweep(R"({"map": "rolling_resistance", "y": "approach"})").err,
             Contains("y = \"approach\": must be an axis"));
  CHECK_THAT(sweep(R"({"map": "speed"})").err, Contains("map = \"speed\": must be a number of the solution"));
  CHECK_THAT(sweep(R"({"map": "approach", "x": "load", "y": "load"})").err, Contains("must differ from x"));
  CHECK_THAT(sweep(R"({"map": "approach", "family": "load"})").err, Contains("is for curves"));
}

TEST_CASE("the optimum of an optimisation is drawn into the map of the same inputs", "[studies][chart]") {
  const TemporaryDirectory scratch;
  const std::string file = stored_grid(scratch, grid());
  const auto study = scratch.write("best.json", R"({"study": "best",
      "scene": {"radius": 0.1, "layer_thickness": 0.01, "static_shear_modulus": 1e6, "material": "elastic",
                "speed": 0.5, "load": 1.5e4},
      "variables": {"speed": {"from": 0.02, "to": 50}, "load": {"from": 1e4, "to": 3e4, "scale": "linear"}},
      "maximise": "rolling_resistance", "constraints": ["load <= 19 kN/m", "speed <= 8 m/s"], "stop": {"evaluations": 120}})");
  run_rollres({"optimise", study.string(), "--db", file}, hill);
  ResultStore store(file, Access::read);
  const auto found = stored_optimum(store, "best");
  REQUIRE(found);
  REQUIRE(found->best);
  CHECK(found->designs.size() > 5);
  CHECK(found->variable("load") == 1);
  CHECK(found->variable("radius") == -1);
  CHECK(found->best->point[1] == Approx(1.9e4).epsilon(0.01));
  CHECK(found->best->value == Approx(199.7).epsilon(0.005));
  CHECK_FALSE(stored_optimum(store, "grid"));

  const ProgramRun run = run_rollres({"chart", "--db", file, "--study", "grid", "--map", "rolling_resistance",
                                      "--optimum", "best", "--out", (scratch / "map").string()},
                                     closed_form);
  CHECK(run.err.empty());
  CHECK(run.status == 0);
  CHECK_THAT(run.out, Contains("largest of the points: rolling resistance 200 N/m at speed 1 m/s, load 20 kN/m\n") &&
                          Contains("best: greatest rolling resistance: at speed"));
  CHECK_THAT(file_text(scratch / "map.svg"), Contains("designs looked at"));
  // What breaks either constraint has a hatch of its own.
  CHECK_THAT(file_text(scratch / "map.gp"), Contains("pattern 4") && Contains("pattern 5"));
}

TEST_CASE("a map that cannot be drawn is refused with what would help", "[studies][chart]") {
  const TemporaryDirectory scratch;
  Study study = grid();
  study.axes.push_back({.key = "radius", .values = {0.1, 0.2}});
  const std::string file = stored_grid(scratch, study);
  const auto refusal = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"chart", "--db", file, "--map", "rolling_resistance"});
    const ProgramRun run = run_rollres(words, closed_form);
    CHECK(run.status == 2);
    return run.err;
  };
  CHECK_THAT(refusal({}),
             Contains("several points at speed = 10 mm/s, load = 10 kN/m; fix the other axes with --where"));
  CHECK_THAT(refusal({"--where", "radius=0.1", "--where", "speed=1"}), Contains("two values at least"));
  CHECK_THAT(refusal({"--x", "speed", "--y", "speed"}), Contains("differ"));
  CHECK_THAT(refusal({"--family", "load"}), Contains("--family = load: is for curves, not for a map"));
  CHECK_THAT(refusal({"--shares"}), Contains("--shares"));
  CHECK_THAT(refusal({"--x", "sped"}), Contains("speed"));
  const ProgramRun alone = run_rollres({"chart", "--db", file, "--optimum", "best"}, closed_form);
  CHECK(alone.status == 2);
  CHECK_THAT(alone.err, Contains("needs --map"));
}
