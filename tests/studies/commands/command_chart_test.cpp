#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "studies/program/commands.hpp"
#include "studies/run/sweep.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;
using Catch::Matchers::Contains;

namespace {

struct Run {
  int status;
  std::string out, err;
};
Run run(const std::vector<std::string>& words) {
  std::ostringstream out, err;
  const int status = run_program(words, {out, err, closed_form});
  return {status, out.str(), err.str()};
}

std::string database(const TemporaryDirectory& scratch, const Evaluate& evaluate = closed_form) {
  const Study study{.name = "speed/load",
                    .base = plain_scene(),
                    .axes = {{.key = "load", .values = {1e4, 2e4}}, {.key = "speed", .values = {0.1, 1, 10}}}};
  run_sweep(study, evaluate, scratch / "results.db");
  return (scratch / "results.db").string();
}

}  // namespace

TEST_CASE("rollres chart draws beside the database and names the peaks and the files", "[studies][chart]") {
  const TemporaryDirectory scratch;
  const std::string file = database(scratch);
  const Run drawn = run({"chart", "--db", file});
  CHECK(drawn.status == 0);
  CHECK(drawn.err.empty());
  CHECK_THAT(drawn.out, Contains("peak of load 20 kN/m: 100 N/m at 1 m/s\n"));
  for (const char* suffix : {".svg", ".png", ".gp", ".dat"}) {
    const auto picture = scratch / ("speed_load" + std::string(suffix));
    CHECK_THAT(drawn.out, Contains(picture.string() + "\n"));
    CHECK(std::filesystem::file_size(picture) > 0);
  }

  const Run part =
      run({"chart", "--db", file, "--y", "contact_nodes", "--where", "load=10 kN/m", "--x-scale", "linear"});
  CHECK(part.status == 0);
  CHECK_THAT(part.out, Contains("speed_load_contact_nodes_load=10_kN_m.svg"));
}

TEST_CASE("rollres chart draws all charts of a study, each into files of its own", "[studies][chart]") {
  const TemporaryDirectory scratch;
  const auto study = scratch.write("study.json", R"({"study": "two", "scene": {"radius": 0.1, "layer_thickness": 0.01,
    "static_shear_modulus": 1e6, "material": "elastic", "load": 1e4}, "axes": {"speed": [0.1, 1, 10], "load": [1e4, 2e4]},
    "charts": [{"x": "speed"}, {"name": "a/b", "x": "load"}]})");
  const std::string file = (scratch / "results.db").string();
  REQUIRE(run({"sweep", study.string(), "--db", file}).status == 0);
  const Run all = run({"chart", "--db", file, "--chart", "all"});
  CHECK(all.status == 0);
  CHECK(std::filesystem::exists(scratch / "two_1.svg"));
  CHECK(std::filesystem::exists(scratch / "two_a_b.svg"));
  CHECK(run({"chart", "--db", file, "--chart", "all", "--out", (scratch / "out.png").string()}).status == 0);
  CHECK(std::filesystem::exists(scratch / "out_1.png"));
  CHECK(std::filesystem::exists(scratch / "out_a_b.png"));
  const Run unknown = run({"chart", "--db", file, "--chart", "c"});
  CHECK(unknown.status == 2);
  CHECK(unknown.err == "rollres: " + file + ": two: chart = c: must be one of 1, a/b\n");
}

TEST_CASE("rollres chart says what is filtered on the picture, and refuses an axis that never changes",
          "[studies][chart]") {
  const TemporaryDirectory scratch;
  const std::string file = database(scratch);
  const std::string out = (scratch / "a").string();
  REQUIRE(run({"chart", "--db", file, "--where", "load=10 kN/m", "--out", out}).status == 0);
  CHECK_THAT(file_text(scratch / "a.svg"), Contains(">load = 10 kN/m, R = 100 mm, H = 10 mm, μ = 0.3  <"));
  const Run constant = run({"chart", "--db", file, "--x", "radius", "--out", out});
  CHECK(constant.status == 2);
  CHECK(constant.err == "rollres: x = radius: is 100 mm in all 6 points shown; these vary: load, speed\n");
}

TEST_CASE("rollres chart tells how many points have no answer", "[studies][chart]") {
  const TemporaryDirectory scratch;
  const std::string file = database(scratch, [](const RollingScene& scene) {
    if (scene.speed > 5) throw std::runtime_error("no");
    return closed_form(scene);
  });
  const Run drawn = run({"chart", "--db", file, "--out", (scratch / "a.png").string()});
  CHECK(drawn.status == 0);
  CHECK_THAT(drawn.err, Contains("2 of 6 points have no answer"));
  CHECK_THAT(file_text(scratch / "a.svg"), Contains("no answer"));
}

TEST_CASE("rollres chart refuses wrong words with status 2 and reports the outside world with status 3",
          "[studies][chart]") {
  const TemporaryDirectory scratch;
  const std::string file = database(scratch);
  CHECK(run({"chart", "--db", file, "--y-scale", "cubic"}).status == 2);
  CHECK(run({"chart", "--db", file, "--where", "speed"}).status == 2);
  CHECK(run({"chart", "--db", file, "--where", "speed=3 kg"}).status == 2);
  CHECK(run({"chart", "--db", file, "--out", ".."}).status == 2);
  const Run unknown = run({"chart", "--db", file, "--study", "speed load"});
  CHECK(unknown.status == 2);
  CHECK_THAT(unknown.err, Contains("did you mean speed/load?"));
  CHECK(run({"chart", "--db", (scratch / "none.db").string()}).status == 3);

  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nowhere", 1);
  const Run no_gnuplot = run({"chart", "--db", file});
  setenv("PATH", path.c_str(), 1);
  CHECK(no_gnuplot.status == 3);
  CHECK_THAT(no_gnuplot.err, Contains("gnuplot: cannot be started") && Contains("gnuplot-nox"));
}
