#include "studies/optimise/design_records.hpp"

#include <set>

#include "studies/text/strict_json.hpp"
#include "tests/catch.hpp"
#include "tests/studies/design_bowl.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;
using Catch::Matchers::Contains;

namespace {

const std::string bowl_head = R"({"study": "bowl", "scene": {"radius": 0.1, "layer_thickness": 0.005,
  "static_shear_modulus": 2e6, "stiffening": 2, "creep_time": 0.1, "speed": 1, "load": 1e4},
  "minimise": {"formula": "rolling_resistance * 2"}, "constraints": ["peak_pressure >= 1 Pa"], "variables": )";
const std::string bowl_box = R"({"layer_thickness": {"from": "1 mm", "to": "20 mm", "scale": "logarithmic"},
  "static_shear_modulus": {"from": "1 MPa", "to": "10 MPa", "scale": "logarithmic"}})";

struct Optimised {
  TemporaryDirectory folder;
  std::string database = folder / "a.db";

  ProgramRun run(const std::string& rest) const {
    return run_rollres({"optimise", folder.write("study.json", bowl_head + rest + "}").string(), "--db", database},
                       Bowl::solve);
  }
  Json query(std::vector<std::string> words) const {
    words.insert(words.begin(), {"query", "--db", database, "--format", "json"});
    return Json::parse(run_rollres(words, Bowl::solve).out);
  }
};

}  // namespace

TEST_CASE("the best designs of an optimisation are a query", "[studies][optimise][design_records]") {
  const Optimised optimised;
  REQUIRE(optimised.run(bowl_box).status == 0);
  const Json best = optimised.query({"study=bowl", "feasible=1", "--sort", "goal", "--limit", "5", "--columns",
                                     "design,position,goal,feasible,rolling_resistance,peak_pressure"});
  REQUIRE(best.size() == 5);
  for (std::size_t i = 0; i < best.size(); ++i) {
    CHECK(best[i]["goal"].get<double>() == Approx(2 * best[i]["rolling_resistance"].get<double>()));
    CHECK(best[i]["peak_pressure"].get<double>() >= 1);
    CHECK(best[i]["design"] == best[i]["position"]);
    if (i > 0) CHECK(best[i]["goal"] >= best[i - 1]["goal"]);
  }
  for (const Json& row : optimised.query({"study=bowl", "feasible=0"})) CHECK(row["peak_pressure"].get<double>() < 1);
  const std::string table =
      run_rollres({"query", "--db", optimised.database, "study=bowl", "--sort", "goal", "--limit", "3"}, Bowl::solve)
          .out;
  CHECK_THAT(table, Contains("layer_thickness [mm]") && Contains("static_shear_modulus [MPa]") && Contains("goal [") &&
                        Contains("feasible"));
  CHECK_THAT(run_rollres({"show", "bowl", "--db", optimised.database}, Bowl::solve).out, Contains("goal ["));
}

TEST_CASE("the goal of a duty cycle stands in the first row of its design", "[studies][optimise][design_records]") {
  const Optimised optimised;
  REQUIRE(
      optimised.run(bowl_box + R"(, "scenes": [{"set": {"load": 1e4}}, {"set": {"load": 2e4}, "weight": 3}])").status ==
      0);
  const Json best = optimised.query({"study=bowl", "--sort", "goal", "--limit", "2"});
  const Json both = optimised.query({"study=bowl", "design=" + best[0]["design"].dump()});
  REQUIRE(both.size() == 2);
  CHECK(both[0]["goal"] == best[0]["goal"]);
  CHECK(both[1]["goal"].is_null());
  CHECK(best[0]["goal"].get<double>() ==
        Approx(2 * (both[0]["rolling_resistance"].get<double>() + 3 * both[1]["rolling_resistance"].get<double>())));
}

TEST_CASE("a front over variants keeps the designs that none of any variant dominates, told apart by their places",
          "[studies][optimise][design_records][choices]") {
  const Optimised optimised;
  const std::string of_variants =
      R"({"variant": {"soft": {"static_shear_modulus": 1e6}, "hard": {"static_shear_modulus": 4e6}},
    "layer_thickness": {"from": "1 mm", "to": "20 mm", "scale": "logarithmic"}},
    "pareto": {"maximise": "peak_pressure", "points": 4})";
  const ProgramRun run = optimised.run(of_variants);
  INFO(run.out << run.err);
  CHECK_THAT(run.out, Contains("front  variant  rolling_resistance * 2  peak_pressure"));
  const Json front = optimised.query({"study=bowl front", "--sort", "front"});
  REQUIRE(front.size() >= 4);
  std::set<std::string> variants;
  for (std::size_t i = 0; i < front.size(); ++i) {
    CHECK(front[i]["front"] == i + 1);
    variants.insert(front[i]["variant"].get<std::string>());
    CHECK(front[i]["second_goal"] == front[i]["peak_pressure"]);
    if (i == 0) continue;
    CHECK(front[i]["goal"] > front[i - 1]["goal"]);
    CHECK(front[i]["second_goal"] > front[i - 1]["second_goal"]);
  }
  // At 4 MPa the bowl is lowest; 1 MPa has a lower pressure at each thickness and is dominated but where none is.
  CHECK(variants.contains("hard"));
  CHECK(optimised.query({"study=bowl", "front!="}).size() == front.size());
}
