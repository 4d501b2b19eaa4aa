#include "studies/figures/film.hpp"

#include <cmath>
#include <sstream>

#include "core/solve/rolling_contact.hpp"
#include "studies/run/sweep.hpp"
#include "studies/scene_io/fields_file.hpp"
#include "tests/catch.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"
#include "tests/studies/vtk_numbers.hpp"

// Covers command_stored_line, too.

using namespace rollres;
using Catch::Matchers::Contains;

namespace {

RollingScene small_cylinder() {
  RollingScene scene;
  scene.radius = 0.02;
  scene.layer_thickness = 0.005;
  scene.static_shear_modulus = 3e6;
  scene.stiffening = 1;
  scene.creep_time = 0.25;
  scene.speed = 0.1;
  scene.load = 2e4;
  scene.friction_coefficient = 0.2;
  return scene;
}

RollingSolution solved(const RollingScene& scene) { return solve(scene); }

std::string swept(const TemporaryDirectory& scratch, std::vector<Axis> axes) {
  const std::string file = (scratch / "results.db").string();
  run_sweep(Study{.name = "speeds", .base = small_cylinder(), .axes = std::move(axes)}, solved, file);
  return file;
}

/// The blocks of a data file.
std::vector<std::vector<std::vector<double>>> blocks_of(const std::string& text) {
  std::vector<std::vector<std::vector<double>>> blocks(1);
  std::istringstream lines(text);
  int blank = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() && ++blank == 2) blocks.emplace_back(), blank = 0;
    if (line.empty() || line.front() == '#') continue;
    std::istringstream words(line);
    auto& row = blocks.back().emplace_back();
    for (std::string word; words >> word;) row.push_back(std::stod(word));
  }
  return blocks;
}

}  // namespace

TEST_CASE("a film shows each speed once, its pressure bearing the load", "[studies][figures][film]") {
  const TemporaryDirectory scratch;
  const std::string file = swept(scratch, {{.key = "speed", .values = {0.01, 0.1, 1}, .logarithmic = true}});
  const ProgramRun run = run_rollres({"film", "--db", file, "--out", (scratch / "new" / "film.gif").string()}, solved);
  INFO(run.err);
  REQUIRE(run.status == 0);
  CHECK_THAT(run.err, Contains("3 scenes were solved again"));
  CHECK_THAT(run.out, Contains("film.gif\n") && Contains("film.gp\n") && Contains("film.dat\n"));
  const std::string film = file_text(scratch / "new" / "film.gif"), control("\x21\xf9\x04", 3);
  CHECK(film.starts_with("GIF89a"));
  std::size_t pictures = 0;
  for (std::size_t at = 0; (at = film.find(control, at)) != std::string::npos; ++at) ++pictures;
  CHECK(pictures == 3);
  const auto blocks = blocks_of(file_text(scratch / "new" / "film.dat"));
  REQUIRE(blocks.size() == 1 + 3 * 3);
  CHECK(blocks[0].size() == 3);
  for (std::size_t frame = 0; frame < 3; ++frame) {
    const auto& rows = blocks[1 + 3 * frame];  // x [mm], pressure [MPa]: trapezia between nodes, in kN/m
    double load = 0;
    for (std::size_t i = 1; i < rows.size(); ++i)
      load += 0.5 * (rows[i][1] + rows[i - 1][1]) * (rows[i][0] - rows[i - 1][0]);
    CHECK(load == Approx(20).epsilon(0.02));  // the rule at the ends, where p rises as a root
  }
  // Fast, all of the contact sticks or slips: the zones lie one behind the other and fill it.
  double length = 0;
  for (const auto& block : {blocks[2], blocks[3]})
    for (const auto& row : block)
      if (std::isfinite(row[0])) length += row[1] - row[0];
  RollingScene slow = small_cylinder();
  slow.speed = 0.01;
  const RollingSolution answer = solve(slow);
  CHECK(length == Approx(1e3 * (answer.leading_edge - answer.trailing_edge)).epsilon(0.01));
}

TEST_CASE("a film over temperatures has its points at degrees Celsius, as its axis says", "[studies][figures][film]") {
  const TemporaryDirectory scratch;
  RollingScene rubber = small_cylinder();
  rubber.reference_temperature = 293.15;
  rubber.wlf_c1 = 17.4;
  rubber.wlf_c2 = 51.6;
  const std::string file = (scratch / "results.db").string();
  run_sweep(Study{.name = "warm", .base = rubber, .axes = {{.key = "temperature", .values = {273.15, 293.15, 313.15}}}},
            solved, file);
  const ProgramRun run = run_rollres({"film", "--db", file, "--out", (scratch / "film").string()}, solved);
  INFO(run.err);
  REQUIRE(run.status == 0);
  CHECK_THAT(file_text(scratch / "film.gp"), Contains("temperature [°C]") && Contains("set xrange [0:40]"));
  const auto points = blocks_of(file_text(scratch / "film.dat")).front();
  REQUIRE(points.size() == 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    CHECK(points[i].front() == Approx(20.0 * static_cast<double>(i)).margin(1e-9));
}

TEST_CASE("a film of several families is refused, with the filter that it lacks", "[studies][figures][film]") {
  const TemporaryDirectory scratch;
  const std::string file =
      swept(scratch, {{.key = "load", .values = {1e4, 2e4}}, {.key = "speed", .values = {0.01, 0.1, 1}}});
  const ProgramRun run = run_rollres({"film", "--db", file}, solved);
  CHECK(run.status == 2);
  CHECK_THAT(run.err, Contains("load has 2 values; a film shows one, choose it with --where 'load=10 kN/m'"));
  const ProgramRun one = run_rollres({"film", "--db", file, "--where", "load=10 kN/m", "--where", "speed=1"}, solved);
  CHECK(one.status == 2);
  CHECK_THAT(one.err, Contains("a film needs two points"));
  CHECK(run_rollres({"film", "--db", file, "--axis", "seed"}, solved).status == 2);
}

TEST_CASE("the fields of a cylinder are a strip for ParaView, each row the same", "[studies][figures][film]") {
  const RollingScene scene = small_cylinder();
  const RollingSolution solution = solve(scene);
  const std::string vti = fields_vti(scene, solution.fields, solution);
  const auto columns = static_cast<std::size_t>(solution.fields.grid.columns);
  CHECK_THAT(vti, Contains("WholeExtent=\"0 " + std::to_string(columns - 1) + " 0 1 0 0\""));
  for (const auto& [name, components] :
       {std::pair("sigma_z [Pa]", 1), std::pair("zone", 1), std::pair("displacement [m]", 3),
        std::pair("traction [Pa]", 3), std::pair("body [m]", 3)}) {
    INFO(name);
    std::vector<double> numbers = vtk_numbers<double>(vti, name);
    if (std::string(name) == "zone") {
      const std::vector<std::int8_t> zones = vtk_numbers<std::int8_t>(vti, name);
      numbers.assign(zones.begin(), zones.end());
    }
    const std::size_t row = columns * static_cast<std::size_t>(components);
    REQUIRE(numbers.size() == 2 * row);
    CHECK(std::equal(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(row),
                     numbers.begin() + static_cast<std::ptrdiff_t>(row)));
  }
  // The body lies on the surface where it touches.
  const std::vector<double> body = vtk_numbers<double>(vti, "body [m]"),
                            surface = vtk_numbers<double>(vti, "displacement [m]");
  for (std::size_t i = 0; i < columns; ++i)
    if (solution.fields.zone[i] != Zone::free)
      CHECK(body[3 * i + 2] == Approx(surface[3 * i + 2]).margin(0.02 * solution.approach));
}
