#include "studies/figures/characteristic.hpp"

#include <cmath>
#include <sstream>

#include "core/solve/rolling_contact.hpp"
#include "studies/run/sweep.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"

// Covers stored_line and command_stored_line, too.

using namespace rollres;
using Catch::Matchers::Contains;

namespace {

RollingScene skewed_cylinder(double friction = 0.3) {
  RollingScene scene = plain_scene();
  scene.friction_coefficient = friction;
  scene.drive = Drive::free;
  return scene;
}

RollingSolution by_core(const RollingScene& scene) { return solve(scene); }

std::string swept(const TemporaryDirectory& scratch, const RollingScene& base, std::vector<double> skews,
                  std::vector<Axis> more = {}) {
  const std::string file = (scratch / "results.db").string();
  more.push_back({"skew_angle", std::move(skews)});
  run_sweep(Study{.name = "idler", .base = base, .axes = std::move(more)}, by_core, file);
  return file;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) ++found;
  return found;
}

}  // namespace

TEST_CASE("a characteristic has the forces of every skew over the load, and the contacts from sticking to sliding",
          "[studies][figures][characteristic]") {
  const TemporaryDirectory scratch;
  const std::vector<double> skews{0, 0.01, 0.03, 0.3};
  const std::string file = swept(scratch, skewed_cylinder(), skews);
  const ProgramRun run =
      run_rollres({"characteristic", "--db", file, "--out", (scratch / "new" / "idler.svg").string()}, by_core);
  INFO(run.err);
  REQUIRE(run.status == 0);
  CHECK_THAT(run.err, Contains("4 scenes were solved again"));
  std::vector<std::vector<double>> rows;
  std::istringstream lines(file_text(scratch / "new" / "idler.dat"));
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line.front() == '#') continue;
    std::istringstream words(line);
    auto& row = rows.emplace_back();
    for (double number = 0; words >> number;) row.push_back(number);
  }
  REQUIRE(rows.size() == skews.size());
  for (std::size_t i = 0; i < skews.size(); ++i) {
    RollingScene scene = skewed_cylinder();
    scene.skew_angle = skews[i];
    const RollingSolution s = solve(scene);
    CAPTURE(skews[i]);
    REQUIRE(rows[i].size() == 5);  // degrees, R_r/P, F_a/P, friction, share; M_z and F_y are none of a cylinder's
    CHECK(rows[i][0] == Approx(skews[i] * 180 / M_PI));
    CHECK(rows[i][1] == Approx(s.rolling_resistance / s.load).epsilon(1e-6));
    CHECK(rows[i][2] == Approx(std::isfinite(s.axial_force) ? s.axial_force / s.load : 0).epsilon(1e-6));
    CHECK(rows[i][3] == 0.3);
    if (i > 0) CHECK(rows[i][4] > rows[i - 1][4]);
  }
  CHECK(rows.back()[4] == 1);  // slides
  CHECK(rows.front()[4] < 0.5);
  const std::string script = file_text(scratch / "new" / "idler.gp");
  // A bar of slip and one of what sticks in the first contact, and of slip in the last.
  CHECK(count(script, "set object polygon") >= 3);
  CHECK_THAT(script, Contains("'100 %'"));
  CHECK_THAT(file_text(scratch / "new" / "idler.svg"), Contains("along the axle"));
}

TEST_CASE("the slipping share of a sphere is that of its nodes, of a cylinder that of its length",
          "[studies][figures][characteristic]") {
  RollingSolution sphere;
  sphere.fields.grid.columns = 2;
  sphere.fields.grid.rows = 3;
  sphere.fields.zone = {Zone::free, Zone::stick, Zone::slip, Zone::stick, Zone::free, Zone::stick};
  CHECK(slipping_share(sphere) == 0.25);
  const RollingSolution cylinder = solve(skewed_cylinder());
  double slips = 0;
  for (const Zone zone : cylinder.fields.zone) slips += zone == Zone::slip ? 1 : 0;
  CHECK(std::abs(slipping_share(cylinder) - slips / cylinder.contact_nodes) < 2.0 / cylinder.contact_nodes);
  CHECK(slipping_share(RollingSolution()) == 0);
}

TEST_CASE("a characteristic without friction, of one point or of several families is refused",
          "[studies][figures][characteristic]") {
  const TemporaryDirectory smooth, single, several;
  CHECK_THAT(run_rollres({"characteristic", "--db", swept(smooth, skewed_cylinder(0), {0, 0.1})}, by_core).err,
             Contains("has no friction"));
  CHECK_THAT(run_rollres({"characteristic", "--db", swept(single, skewed_cylinder(), {0.1})}, by_core).err,
             Contains("needs two points with an answer, there is one"));
  const std::string file = swept(several, skewed_cylinder(), {0, 0.02}, {{"load", {1e4, 2e4}}});
  CHECK_THAT(run_rollres({"characteristic", "--db", file, "--axis", "skew_angle"}, by_core).err,
             Contains("load has 2 values; a characteristic shows one, choose it with --where 'load=10 kN/m'"));
  const TemporaryDirectory straight;
  const std::string unturned = (straight / "results.db").string();
  run_sweep(Study{.name = "belt", .base = skewed_cylinder(), .axes = {{"speed", {0.1, 0.2}}}}, by_core, unturned);
  CHECK_THAT(run_rollres({"characteristic", "--db", unturned}, by_core).err,
             Contains("belt: has no axis along which a characteristic could go: skew_angle, ") &&
                 Contains("--axis takes any: speed"));
  CHECK_THAT(run_rollres({"characteristic", "--db", unturned, "--axis", "skew_angle"}, by_core).err,
             Contains("belt: --axis = skew_angle: all points have the same; axes are speed"));
}
