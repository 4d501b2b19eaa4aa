#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/source_directory.hpp"
#include "tests/studies/design_bowl.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"

// Covers optimise_report, too.

using namespace rollres;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

const char* const bowl_study = R"({"study": "bowl",
  "scene": {"radius": 0.1, "layer_thickness": 0.005, "static_shear_modulus": 2e6, "stiffening": 2, "creep_time": 0.1,
            "speed": 1, "load": 1e4, "friction_coefficient": 0.3},
  "variables": {"layer_thickness": {"from": "1 mm", "to": "20 mm"}, "static_shear_modulus": {"from": 1e6, "to": 1e7}},
  "minimise": "rolling_resistance", "constraints": ["peak_pressure >= 1 Pa"])";

}  // namespace

TEST_CASE("rollres optimise prints the optimum, stores its evaluations as a study and repeats itself at no cost",
          "[studies][optimise]") {
  const TemporaryDirectory folder;
  const std::string study = folder.write("bowl.json", std::string(bowl_study) + "}"), db = folder / "results.db";
  const ProgramRun text = run_rollres({"optimise", study, "--db", db, "--out", folder / "course"}, Bowl::solve);
  CHECK(text.status == 0);
  CHECK_THAT(text.out, Catch::StartsWith("bowl: optimum\nminimise rolling_resistance: 1.0") &&
                           Contains("layer_thickness") && Contains("active") && Contains("searched by cobyla (") &&
                           Contains(" 0 recalled"));
  CHECK(std::filesystem::file_size(folder / "course.png") > 10000);

  const ProgramRun again = run_rollres({"optimise", study, "--db", db, "--json", "--jobs", "2"}, Bowl::solve);
  const json answer = json::parse(again.out);
  CHECK(answer["status"] == "optimum");
  CHECK(answer["evaluations"]["solved"] == 0);
  CHECK(answer["constraints"][0]["active"] == true);
  CHECK(answer["variables"][0]["bound"] == "none");
  const std::string count = std::to_string(answer["evaluations"]["all"].get<int>());
  CHECK_THAT(run_rollres({"list", "--db", db}, Bowl::solve).out, Contains("bowl") && Contains(count));
  const ProgramRun rows = run_rollres({"query", "--db", db, "study=bowl", "--format", "csv"}, Bowl::solve);
  CHECK(rows.status == 0);
  CHECK(run_rollres({"chart", "--db", db, "--study", "bowl", "--x", "layer_thickness", "--out", folder / "points"},
                    Bowl::solve)
            .status == 0);
}

TEST_CASE("an optimum is told with the warnings and the model error of its answers, and broken designs are hollow",
          "[studies][optimise]") {
  const TemporaryDirectory folder;
  const std::string db = folder / "results.db";
  std::string file = bowl_study;
  file.replace(file.find(">= 1 Pa"), 7, ">= 1.2 Pa");
  const std::string study = folder.write("bowl.json", file + "}");
  const auto doubtful = [](const RollingScene& scene) {
    RollingSolution solution = Bowl::solve(scene);
    solution.warnings = {"linear layer: 12 % off"};
    solution.model_error = 0.12;
    return solution;
  };
  const ProgramRun text = run_rollres({"optimise", study, "--db", db}, doubtful);
  CHECK(text.status == 0);
  CHECK_THAT(text.out, Contains("\nwarning  linear layer: 12 % off\n") &&
                           Contains("what is assumed changes R_r by about 12 %\n"));
  const json best = json::parse(run_rollres({"optimise", study, "--db", db, "--json"}, doubtful).out)["best"];
  CHECK(best["warnings"] == json{"linear layer: 12 % off"});
  CHECK(best["model_error"] == 0.12);
  REQUIRE(run_rollres({"chart", "--db", db, "--out", folder / "designs"}, doubtful).status == 0);
  CHECK_THAT(file_text(folder / "designs.svg"), Contains("breaks a constraint"));
  CHECK_THAT(file_text(folder / "designs.dat"), Contains("column 3: 0 if it breaks a constraint, else 1"));
}

TEST_CASE("rollres show of an optimisation begins with its best design, and knows the evaluations that it names",
          "[studies][optimise][show]") {
  const TemporaryDirectory folder;
  const std::string study = folder.write("bowl.json", std::string(bowl_study) + "}"), db = folder / "results.db";
  const ProgramRun text = run_rollres({"optimise", study, "--db", db}, Bowl::solve);
  REQUIRE(text.status == 0);
  const double best =
      json::parse(run_rollres({"optimise", study, "--db", db, "--json"}, Bowl::solve).out)["value"].get<double>();
  const json rows = json::parse(run_rollres({"show", "bowl", "--db", db, "--json"}, Bowl::solve).out)["results"];
  REQUIRE(rows.size() > 20);
  CHECK(rows[0]["goal"] == best);
  CHECK(rows[0]["feasible"] == 1);
  CHECK(rows[1]["goal"].get<double>() >= best);
  CHECK(rows.back()["feasible"] == 0);
  const std::string shown = run_rollres({"show", "bowl", "--db", db}, Bowl::solve).out;
  CHECK(std::count(shown.begin(), shown.end(), '\n') < 27);
  CHECK_THAT(shown, Contains("the best 20 designs come first"));
  const std::size_t named = text.out.find("evaluation ") + 11;
  const ProgramRun one =
      run_rollres({"show", text.out.substr(named, text.out.find('\n', named) - named), "--db", db}, Bowl::solve);
  CHECK(one.status == 0);
  CHECK_THAT(one.out, Contains("a point of the study bowl"));
}

TEST_CASE("rollres optimise ends with status 1 without an optimum, 2 for wrong words", "[studies][optimise]") {
  const TemporaryDirectory folder;
  const std::string db = folder / "results.db";
  const std::string none = folder.write(
      "none.json",
      std::string(bowl_study)
              .replace(std::string(bowl_study).find("\"peak_pressure >= 1 Pa\""), 23, "\"peak_pressure >= 100 Pa\"") +
          "}");
  const ProgramRun text = run_rollres({"optimise", none, "--db", db}, Bowl::solve);
  CHECK(text.status == 1);
  CHECK_THAT(text.out, Contains("no_feasible_design") && Contains("broken: peak_pressure >= 100"));
  const ProgramRun object = run_rollres({"optimise", none, "--db", db, "--json"}, Bowl::solve);
  CHECK(object.status == 1);
  CHECK(json::parse(object.out)["value"].is_null());

  const std::string good = folder.write("good.json", std::string(bowl_study) + "}");
  CHECK(run_rollres({"optimise", good, "--db", db, "--algorithm", "simplex"}, Bowl::solve).status == 2);
  CHECK(run_rollres({"optimise", good, "--db", db, "--max-evaluations", "0"}, Bowl::solve).status == 2);
  const ProgramRun other = run_rollres({"optimise", good, "--db", db}, Bowl::solve);
  CHECK(other.status == 2);
  CHECK_THAT(other.err, Contains("is there already, defined otherwise: constraints"));
  const ProgramRun few =
      run_rollres({"optimise", good, "--db", db, "--replace", "--max-evaluations", "5", "--json"}, Bowl::solve);
  CHECK(few.status == 1);
  CHECK(json::parse(few.out)["status"] == "evaluation_limit");
  CHECK(run_rollres({"optimise", folder / "missing.json", "--db", db}, Bowl::solve).status == 3);
}

TEST_CASE("rollres optimise stores and draws a front", "[studies][optimise]") {
  const TemporaryDirectory folder;
  const std::string db = folder / "results.db";
  const std::string study =
      folder.write("bowl.json", std::string(bowl_study) + R"(, "pareto": {"maximise": "peak_pressure", "points": 5}})");
  const ProgramRun text = run_rollres({"optimise", study, "--db", db, "--out", folder / "front"}, Bowl::solve);
  CHECK(text.status == 0);
  CHECK_THAT(text.out, Contains("the front is stored as study \"bowl front\""));
  CHECK(std::filesystem::file_size(folder / "front.png") > 10000);
  const json answer = json::parse(run_rollres({"optimise", study, "--db", db, "--json"}, Bowl::solve).out);
  CHECK(answer["front"].size() == 5);
  CHECK(answer["evaluations"]["solved"] == 0);
  CHECK(json::parse(run_rollres({"show", "bowl front", "--db", db, "--json"}, Bowl::solve).out)["points"] == 5);
}

TEST_CASE("the example of an optimisation finds the optimum of a dense sweep within 0.5 % in under 60 evaluations",
          "[studies][examples][long]") {
  const TemporaryDirectory folder;
  const ProgramRun run = run_rollres({"optimise", source_directory().string() + "/studies/examples/optimise_layer.json",
                                      "--db", folder / "results.db", "--json"},
                                     [](const RollingScene& scene) { return solve(scene); });
  CHECK(run.status == 0);
  const json answer = json::parse(run.out);
  CHECK(answer["status"] == "optimum");
  CHECK(answer["value"].get<double>() <= 1.005 * 220.925);  // least of a sweep of 1586 points, refined
  CHECK(answer["evaluations"]["all"].get<int>() - answer["slope_evaluations"].get<int>() < 60);
  CHECK(answer["constraints"][0]["left"].get<double>() <= 4e6);
}
