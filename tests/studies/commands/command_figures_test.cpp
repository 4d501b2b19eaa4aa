#include <algorithm>
#include <filesystem>

#include "core/solve/rolling_contact.hpp"
#include "studies/figures/figure.hpp"
#include "studies/run/sweep.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/source_directory.hpp"
#include "tests/studies/figure_blocks.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"

// Covers collections of fields, too.

using namespace rollres;
using Catch::Matchers::Contains;

namespace {

ProgramRun solving(const std::vector<std::string>& words) {
  return run_rollres(words, [](const RollingScene& scene) { return solve(scene); });
}
ProgramRun guarded(const std::vector<std::string>& words) {
  return run_rollres(words, [](const RollingScene&) -> RollingSolution {
    FAIL("solved in spite of bad input");
    return {};
  });
}

void check_pictures(const std::filesystem::path& folder, const std::string& out, Indenter indenter) {
  for (const Figure& figure : all_figures()) {
    if (figure.dimension != dimension_of(indenter) || figure.name == "temperature") continue;  // of warmed layers
    const std::string name = figure.file_name();
    CAPTURE(name);
    CHECK_THAT(out, Contains((folder / (name + ".svg")).string() + "\n"));
    const std::string svg = file_text(folder / (name + ".svg"));
    CHECK(well_formed(svg));
    CHECK(std::count(svg.begin(), svg.end(), '\n') > 60);
    // gnuplot leaves out a label for which a margin has no room.
    int lengths = 0;
    for (auto at = svg.find("[mm]"); at != std::string::npos; at = svg.find("[mm]", at + 1)) ++lengths;
    CHECK(lengths >= (indenter == Indenter::sphere ? 2 : 1));
    CHECK(file_text(folder / (name + ".png")).starts_with("\x89PNG"));
    CHECK(file_text(folder / (name + ".gp")).find("'./" + name + ".dat'") != std::string::npos);
    for (const auto& [block, all] : figure_blocks(file_text(folder / (name + ".dat"))))
      for (const FigureBlock& one : all) {
        CAPTURE(block);
        CHECK_FALSE(one.empty());
      }
  }
  CHECK(well_formed(file_text(folder / "fields.vti")));
}

/// Two speeds and two loads, with or without fields.
std::string database_of_two_speeds(const TemporaryDirectory& scratch, bool with_fields) {
  const Study study{.name = "two speeds",
                    .base = plain_scene(),
                    .axes = {{.key = "load", .values = {1e4, 2e4}}, {.key = "speed", .values = {1, 0.1}}}};
  run_sweep(study, [](const RollingScene& scene) { return solve(scene); }, scratch / "results.db",
            {.fields = with_fields ? Fields::kept : Fields::dropped});
  return (scratch / "results.db").string();
}

}  // namespace

TEST_CASE("rollres figures draws the paper's figures of both of its scenes", "[studies][figure][long]") {
  const TemporaryDirectory scratch;
  const ProgramRun sphere = solving({"figures", example("paper_sphere.json"), "--out", scratch / "sphere"});
  CHECK(sphere.status == 0);
  CHECK(sphere.err.empty());
  check_pictures(scratch / "sphere", sphere.out, Indenter::sphere);
  const ProgramRun cylinder = solving({"figures", example("paper_cylinder.json"), "--out", scratch / "cylinder"});
  CHECK(cylinder.status == 0);
  check_pictures(scratch / "cylinder", cylinder.out, Indenter::cylinder);
}

TEST_CASE("rollres figures draws single figures, by any method, with and without friction", "[studies][figure]") {
  const TemporaryDirectory scratch;
  for (const std::string setting : {"tolerance=1e-6", "method=newton", "method=active_set"}) {
    CAPTURE(setting);
    const auto folder = scratch / setting;
    const ProgramRun run = solving(
        {"figures", example("paper_cylinder.json"), "--set", setting, "--figure", "3", "--out", folder.string()});
    CHECK(run.status == 0);
    CHECK(run.out ==
          (folder / "fields.vti").string() + "\n" + (folder / "figure_03_displacements.svg").string() + "\n");
  }
  const ProgramRun smooth = solving({"figures", example("paper_sphere.json"), "--set", "friction_coefficient=0",
                                     "--set", "spacing=0.5 mm", "--figure", "zones", "--out", scratch / "smooth"});
  CHECK(smooth.status == 0);
  CHECK(smooth.out ==
        (scratch / "smooth/fields.vti").string() + "\n" + (scratch / "smooth/figure_05_zones.svg").string() + "\n");
}

TEST_CASE("rollres figures refuses bad input before it solves, and says why a scene has no figures",
          "[studies][figure]") {
  const TemporaryDirectory scratch;
  const std::string out = scratch / "out", scene = example("paper_sphere.json");
  const auto refused = [&](std::vector<std::string> words, const std::string& why) {
    words.insert(words.begin(), "figures");
    const ProgramRun run = guarded(words);
    CHECK(run.status == 2);
    CHECK_THAT(run.err, Contains(why));
    CHECK_FALSE(std::filesystem::exists(out));
  };
  refused({"--out", out}, "give either a scene file, or --db");
  refused({scene, "--db", "x.db", "--out", out}, "give either a scene file, or --db");
  refused({scene}, "--out");
  refused({scene, "--out", ""}, "--out = \"\": must name a directory");
  refused({scene, "--out", out, "--set", "speed=-1"}, "speed = -1");
  refused({scene, "--out", out, "--figure", "3"}, "--figure = 3: a figure of a cylinder");
  refused({scene, "--out", out, "--study", "s"}, "--study: needs --db");
  refused({"--db", "x.db", "--out", out, "--figure", "3"}, "--figure: needs a scene file");
  const ProgramRun sliding = run_rollres({"figures", scene, "--out", out}, [](const RollingScene&) {
    RollingSolution none;
    none.status = Status::no_steady_state;
    none.reason = "too much traction";
    return none;
  });
  CHECK(sliding.status == 1);
  CHECK_THAT(sliding.err, Contains("nothing drawn: no_steady_state, too much traction"));
}

TEST_CASE("the stored fields of a study become VTK collections with an axis as the time", "[studies][figure]") {
  const TemporaryDirectory scratch;
  const std::string file = database_of_two_speeds(scratch, true);
  const ProgramRun run = guarded({"figures", "--db", file, "--axis", "speed", "--out", scratch / "film"});
  CHECK(run.status == 0);
  CHECK(run.err.empty());
  const std::string first = (scratch / "film/two_speeds_load=10_kN_m.pvd").string();
  CHECK(run.out == first + "\n" + (scratch / "film/two_speeds_load=20_kN_m.pvd").string() + "\n");
  const std::string film = file_text(first);
  CHECK(well_formed(film));
  const auto slow = film.find("<DataSet timestep=\"0.1\" part=\"0\" file=\"two_speeds/0002.vti\"/>");
  const auto fast = film.find("<DataSet timestep=\"1\" part=\"0\" file=\"two_speeds/0001.vti\"/>");
  REQUIRE(slow != std::string::npos);
  REQUIRE(fast != std::string::npos);
  CHECK(slow < fast);
  for (const char* number : {"0001", "0002", "0003", "0004"})
    CHECK(well_formed(file_text(scratch / ("film/two_speeds/" + std::string(number) + ".vti"))));

  const ProgramRun unknown = guarded({"figures", "--db", file, "--axis", "radius", "--out", scratch / "film"});
  CHECK(unknown.status == 2);
  CHECK_THAT(unknown.err, Contains("--axis = radius: is no axis of two speeds"));
}

TEST_CASE("a study without stored fields says how to store them", "[studies][figure]") {
  const TemporaryDirectory scratch;
  const ProgramRun run =
      guarded({"figures", "--db", database_of_two_speeds(scratch, false), "--out", scratch / "film"});
  CHECK(run.status == 1);
  CHECK_THAT(run.err, Contains("4 points have no stored fields; rollres sweep STUDY --fields stores them"));
}
