#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/catch.hpp"
#include "tests/source_directory.hpp"
#include "tests/studies/design_bowl.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"

// Covers bar_chart, too.

using namespace rollres;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

/// R = load * speed^2 / radius: its elasticities are 1, 2 and -1.
RollingSolution power_law(const RollingScene& scene) {
  RollingSolution solution = closed_form(scene);
  solution.rolling_resistance = *scene.load * scene.speed * scene.speed / scene.radius;
  return solution;
}

}  // namespace

TEST_CASE("sensitivity sorts the elasticities of all inputs that are present by their size", "[studies][sensitivity]") {
  const TemporaryDirectory folder;
  const ProgramRun object =
      run_rollres({"sensitivity", example("paper_cylinder.json"), "--json", "--out", folder / "bars"}, power_law);
  CHECK(object.status == 0);
  const json inputs = json::parse(object.out)["inputs"];
  REQUIRE(inputs.size() == 10);  // neither spacing, nor what is absent or zero
  CHECK(inputs[0]["key"] == "speed");
  CHECK(inputs[0]["elasticity"].get<double>() == Approx(2).epsilon(1e-8));
  CHECK(std::abs(inputs[1]["elasticity"].get<double>()) == Approx(1).epsilon(1e-8));
  CHECK(std::abs(inputs[2]["elasticity"].get<double>()) == Approx(1).epsilon(1e-8));
  for (std::size_t i = 3; i < inputs.size(); ++i) CHECK(inputs[i]["elasticity"] == 0.0);
  for (const json& input : inputs) CHECK(input["key"] != "spacing");
  CHECK(std::filesystem::file_size(folder / "bars.png") > 10000);
  CHECK_THAT(file_text(folder / "bars.svg"), Contains("radius"));
  const ProgramRun text = run_rollres({"sensitivity", example("paper_cylinder.json"), "--set", "speed=1"}, power_law);
  CHECK(text.out.find("\nspeed ") < text.out.find("\nload "));
}

TEST_CASE("sensitivity refuses rows of Sobol' that are no power of two", "[studies][sensitivity]") {
  const ProgramRun run = run_rollres({"sensitivity", example("paper_cylinder.json"), "--indices", "sobol", "--samples",
                                      "30", "--range", "load=10 kN/m:30 kN/m"},
                                     power_law);
  CHECK(run.status == ExitStatus::wrong_input);
  CHECK_THAT(run.err, Contains("--samples = 30: must be a power of two with sobol: 16 or 32"));
}

TEST_CASE("sensitivity gives indices over ranges of a scene and over those of study files", "[studies][sensitivity]") {
  const TemporaryDirectory folder;
  const std::string db = folder / "results.db";
  const std::vector<std::string> words{"sensitivity",   example("paper_cylinder.json"),
                                       "--indices",     "sobol",
                                       "--samples",     "64",
                                       "--range",       "load=10 kN/m:30 kN/m",
                                       "--range",       "creep_time=0.1:0.2",
                                       "--db",          db,
                                       "--json",        "--out",
                                       folder / "sobol"};
  const ProgramRun run = run_rollres(words, power_law);
  CHECK(run.status == 0);
  const json answer = json::parse(run.out);
  CHECK(answer["inputs"][0]["input"] == "load");
  CHECK(answer["inputs"][0]["total"].get<double>() == Approx(1).margin(0.05));
  CHECK(answer["inputs"][1]["total"] == 0.0);
  CHECK(std::filesystem::file_size(folder / "sobol.png") > 10000);
  const json again = json::parse(run_rollres(words, power_law).out);
  CHECK(again["evaluations"]["solved"] == 0);
  CHECK(again["inputs"] == answer["inputs"]);
  CHECK_THAT(run_rollres({"list", "--db", db}, power_law).out, Contains("paper_cylinder sobol"));

  const std::string sweep =
      folder.write("sweep.json", R"({"study": "s", "scene": ")" + example("paper_cylinder.json") + R"(",
      "axes": {"speed": {"from": 1, "to": 2, "points": 2}, "load": [1e4, 2e4]}})");
  const json morris = json::parse(run_rollres({"sensitivity", sweep, "--indices", "morris", "--json"}, power_law).out);
  REQUIRE(morris["inputs"].size() == 1);
  CHECK(morris["inputs"][0]["input"] == "speed");
  CHECK(morris["inputs"][0]["mean"].get<double>() == Approx(1e4 / 0.02 * 3).epsilon(0.05));

  const std::string design = source_directory().string() + "/studies/examples/optimise_layer.json";
  const json box = json::parse(
      run_rollres({"sensitivity", design, "--indices", "sobol", "--samples", "64", "--json"}, Bowl::solve).out);
  CHECK(box["inputs"].size() == 2);
  CHECK(box["output"] == "rolling_resistance");
}

TEST_CASE("sensitivity refuses ranges that are none", "[studies][sensitivity]") {
  const auto refusal = [](const std::vector<std::string>& more) {
    std::vector<std::string> words{"sensitivity", example("paper_cylinder.json")};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramRun run = run_rollres(words, power_law);
    CHECK(run.status == 2);
    return run.err;
  };
  CHECK_THAT(refusal({"--indices", "sobol"}), Contains("--range: there must be at least one"));
  CHECK_THAT(refusal({"--indices", "sobol", "--range", "load=1"}), Contains("must be KEY=FROM:TO"));
  CHECK_THAT(refusal({"--indices", "sobol", "--range", "load=2:1"}), Contains("larger than the first end"));
  CHECK_THAT(refusal({"--indices", "sobol", "--range", "method=newton:spectral"}), Contains("must be a real number"));
  CHECK_THAT(refusal({"--indices", "sobol", "--range", "lod=1:2"}), Contains("did you mean load"));
  CHECK_THAT(refusal({"--indices", "sobol", "--range", "friction_coefficient=0:1:logarithmic"}),
             Contains("both ends must be > 0"));
  CHECK_THAT(refusal({"--indices", "fast", "--range", "load=1:2"}), Contains("fast"));
  CHECK_THAT(refusal({"--range", "load=1:2"}), Contains("--indices"));
  CHECK_THAT(refusal({"--output", "resistance"}), Contains("--output: resistance: unknown output"));
}

TEST_CASE("indices do not take the place of another study of their name unasked", "[studies][sensitivity]") {
  const TemporaryDirectory folder;
  const auto run = [&](const char* radius, std::vector<std::string> more) {
    const auto file = folder.write("study.json", R"({"study": "s", "axes": {"speed": {"from": 1, "to": 2, "points": 2}},
      "scene": {"radius": )" + std::string(radius) + R"(, "layer_thickness": 0.01, "static_shear_modulus": 1e6,
                "stiffening": 1, "creep_time": 0.1, "load": 1e4, "friction_coefficient": 0}})");
    more.insert(more.begin(),
                {"sensitivity", file, "--indices", "morris", "--samples", "2", "--db", folder / "results.db"});
    return run_rollres(more, power_law);
  };
  CHECK(run("0.1", {}).status == 0);
  const ProgramRun refused = run("0.2", {});
  CHECK(refused.status == 2);
  CHECK_THAT(refused.err, Contains("study = s morris: is there already, defined otherwise: scene.radius 0.1 -> 0.2"));
  const ProgramRun replaced = run("0.2", {"--replace"});
  CHECK(replaced.status == 0);
  CHECK_THAT(replaced.err, Contains("s morris: defined anew: "));
}
