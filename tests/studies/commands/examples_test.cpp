#include <algorithm>

#include "core/solve/rolling_contact.hpp"
#include "studies/text/strict_json.hpp"
#include "tests/catch.hpp"
#include "tests/source_directory.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;
namespace {

Json solved(const std::string& name, const std::string& method) {
  const ProgramRun run = run_rollres({"solve", example(name), "--json", "--set", "method=" + method},
                                     [](const RollingScene& scene) { return solve(scene); });
  REQUIRE(run.status == 0);
  return Json::parse(run.out);
}

}  // namespace

TEST_CASE("the program reproduces the paper's cylinder by each of its methods", "[studies][examples]") {
  for (const std::string method : {"newton", "newton_dense", "active_set"}) {
    CAPTURE(method);
    const Json answer = solved("paper_cylinder.json", method);
    CHECK(answer["contact_nodes"] == 31);
    CHECK(answer["slip_nodes"] == 4);
    CHECK(answer["rotation_ratio"] == Approx(1.0405).margin(1e-4));
    CHECK(answer["approach"] == Approx(0.3698e-3).epsilon(1e-3));
    CHECK(answer["rolling_resistance"] == Approx(357.5).epsilon(1e-3));
    CHECK(answer["law_violation"] < 1e-8);
    CHECK(answer["energy_residual"] < 5e-3);
  }
}

TEST_CASE("the program reproduces the paper's sphere with every node inside the laws", "[studies][examples]") {
  const Json answer = solved("paper_sphere.json", "newton");
  CHECK(answer["contact_nodes"] == 939);
  CHECK(answer["leading_edge"] == Approx(4.25e-3).epsilon(1e-9));
  CHECK(answer["trailing_edge"] == Approx(-3.75e-3).epsilon(1e-9));
  CHECK(answer["mean_pressure"] == Approx(2.556e6).epsilon(5e-3));
  CHECK(answer["rolling_resistance"] == Approx(3.099).epsilon(3e-3));
  CHECK(answer["peak_shear_y"] == Approx(0.343e6).epsilon(0.02));
  CHECK(answer["law_violation"] < 1e-8);
  CHECK(answer["energy_residual"] < 5e-3);
}

TEST_CASE("both example studies are solved in full and drawn", "[studies][examples][long]") {
  const TemporaryDirectory folder;
  for (const auto& [name, points] :
       {std::pair<std::string, int>{"speed_resistance", 180}, {"speed_resistance_sphere", 13}}) {
    CAPTURE(name);
    const std::string database = folder / (name + ".db");
    const Evaluate evaluate = [](const RollingScene& scene) { return solve(scene); };
    const ProgramRun sweep = run_rollres({"sweep", example(name + ".json"), "--db", database, "--json"}, evaluate);
    CHECK(sweep.status == 0);
    const ProgramRun query = run_rollres({"query", "--db", database, "status=converged", "--format", "json"}, evaluate);
    REQUIRE(query.status == 0);
    CHECK(std::count(query.out.begin(), query.out.end(), '\n') >= points);
    const ProgramRun chart = run_rollres({"chart", "--db", database, "--out", folder / name}, evaluate);
    CHECK(chart.status == 0);
    CHECK(std::filesystem::file_size(folder / (name + ".png")) > 10000);
  }
}
