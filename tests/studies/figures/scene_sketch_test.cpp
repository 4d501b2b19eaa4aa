#include "studies/figures/scene_sketch.hpp"

#include <algorithm>
#include <cmath>

#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/core/paper_scenes.hpp"
#include "tests/source_directory.hpp"
#include "tests/studies/figure_blocks.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"

// Covers command_draw, too.

using namespace rollres;
using Catch::Matchers::Contains;

namespace {

const ChartFiles sketch_files{"f.gp", "f.dat", "f.svg", "f.png"};

RollingScene gridless() {
  RollingScene scene = paper_cylinder();
  scene.spacing.reset();
  return scene;
}

auto blocks_of(const RollingScene& scene, const RollingSolution& solution) {
  return figure_blocks(scene_sketch(scene, solution, "a scene", sketch_files).data);
}

double lowest(const FigureBlock& block) {
  double z = INFINITY;
  for (const auto& row : block) z = std::min(z, row[1]);
  return z;
}

}  // namespace

TEST_CASE("the body of a sketch is a circle of its radius that stands at the approach", "[studies][figure]") {
  const RollingScene scene = gridless();
  const RollingSolution solution = solve(scene);
  const auto blocks = blocks_of(scene, solution);
  const double d = 1e3 * solution.approach, radius = 20;  // [mm]
  for (const auto& row : blocks.at("rigid body").front())
    CHECK(std::hypot(row[0], row[1] - (radius - d)) == Approx(radius).epsilon(1e-6));
  CHECK(lowest(blocks.at("rigid body").front()) == Approx(-d).epsilon(1e-5));
  CHECK(lowest(blocks.at("layer").front()) == Approx(-5).epsilon(1e-6));
  // The contact lies on the circle, from edge to edge, slip behind and ahead of stick.
  std::vector<double> x;
  for (const char* zone : {"stick", "slip"})
    for (const auto& row : blocks.at(zone).front())
      if (!row.empty()) {
        x.push_back(row[0]);
        CHECK(std::hypot(row[0], row[1] - (radius - d)) == Approx(radius).epsilon(1e-6));
      }
  CHECK(*std::min_element(x.begin(), x.end()) == Approx(1e3 * solution.trailing_edge).epsilon(1e-4));
  CHECK(*std::max_element(x.begin(), x.end()) == Approx(1e3 * solution.leading_edge).epsilon(1e-4));
}

TEST_CASE("a sketch names radius, thickness, load, speed and drive with their values", "[studies][figure]") {
  const RollingScene scene = gridless();
  const std::string script = scene_sketch(scene, solve(scene), "a scene", sketch_files).script;
  for (const char* words : {"{/:Italic R} = 20 mm", "{/:Italic H} = 5 mm", "{/:Italic P} = 20 kN/m",
                            "{/:Italic V} = 50 mm/s", "{/:Italic Q} = ", "{/:Italic RΩ}/{/:Italic V} = 1.04"})
    CHECK_THAT(script, Contains(words));
  RollingScene wide = scene;
  wide.width = 0.1;
  *wide.load *= *wide.width;
  CHECK_THAT(scene_sketch(wide, solve(wide), "a scene", sketch_files).script, Contains("{/:Italic P} = 2 kN "));
}

TEST_CASE("a sketch names the angles of a turned axle that are not zero, above the speed and clear of the body",
          "[studies][figure]") {
  RollingScene sphere = paper_sphere();
  sphere.camber_angle = 20 * M_PI / 180;
  RollingSolution answer;
  answer.skew_angle = 0;
  std::string script = scene_sketch(sphere, answer, "a scene", sketch_files).script;
  CHECK_THAT(script, Contains("{/:Italic γ} = 20 °") && !Contains("{/:Italic α}"));
  RollingScene idler = gridless();
  idler.skew_angle = 0.1;
  idler.axial_force = -1.109e3;
  script = scene_sketch(idler, RollingSolution(), "a scene", sketch_files).script;
  const auto height = [&](const std::string& words) {
    double x = 0, z = 0;
    const std::size_t place = script.find(" at ", script.find("set label '" + words));
    REQUIRE(std::sscanf(script.c_str() + place, " at %lf,%lf", &x, &z) == 2);
    return z;
  };
  const double speed = height("{/:Italic V}");
  CHECK(height("{/:Italic α} = 5.73 °") > speed);
  CHECK(height("{/:Italic F}_{a}") > height("{/:Italic α} = 5.73 °"));
}

TEST_CASE("of a coated wheel on a hard floor the coating is drawn flat, of a layer the layer is dented",
          "[studies][figure]") {
  RollingScene wheel = gridless();
  wheel.layer_thickness = INFINITY;
  wheel.material = MaterialModel::elastic;
  wheel.static_shear_modulus = 1e10;
  BondedLayer& tyre = wheel.coating_layers.emplace_back();
  tyre.layer_thickness = 0.005;
  tyre.static_shear_modulus = 3e6;
  tyre.stiffening = 1;
  tyre.creep_time = 0.25;
  const RollingSolution solution = solve(wheel);
  REQUIRE(solution.status == Status::converged);
  const auto blocks = blocks_of(wheel, solution);
  CHECK(lowest(blocks.at("coating [0]").front()) == 0);
  for (const auto& row : blocks.at("layer").front())
    if (row[1] > -1) CHECK(row[1] == 0);
}

TEST_CASE("every layer of a sketch ends where the next begins, and a thin one shows the lower part of the body",
          "[studies][figure]") {
  RollingScene scene = gridless();
  scene.layer_thickness = 0.0005;
  BondedLayer& lower = scene.lower_layers.emplace_back();
  lower.layer_thickness = 0.0007;
  lower.static_shear_modulus = 3e6;
  RollingSolution none;  // no answer: the body touches the undeformed surface
  const PictureText text = scene_sketch(scene, none, "a scene", sketch_files);
  const auto blocks = figure_blocks(text.data);
  CHECK(lowest(blocks.at("layer").front()) == Approx(-0.5));
  CHECK(lowest(blocks.at("lower layer [0]").front()) == Approx(-1.2));
  CHECK(lowest(blocks.at("rigid body").front()) == Approx(0).margin(1e-9));
  CHECK_FALSE(blocks.contains("contact"));
  CHECK_FALSE(blocks.contains("stick"));
  CHECK_THAT(text.script, Contains("set xrange [-23."));
}

TEST_CASE("rollres draw draws any scene, and says so where it has no answer", "[studies][figure]") {
  const TemporaryDirectory scratch;
  const Evaluate evaluate = [](const RollingScene& scene) { return solve(scene); };
  const std::string out = (scratch / "sphere").string();
  const ProgramRun drawn = run_rollres({"draw", example("paper_sphere.json"), "--out", out}, evaluate);
  CHECK(drawn.status == 0);
  const std::string svg = file_text(scratch / "sphere.svg");
  CHECK(well_formed(svg));
  CHECK_THAT(svg, Contains("<title>paper sphere: rolling resistance 3.099") &&
                      Contains("a sphere of 20 mm radius on one layer, drawn to scale"));
  const ProgramRun none = run_rollres({"draw", example("paper_sphere.json"), "--out", out},
                                      [](const RollingScene&) { return RollingSolution(); });
  CHECK(none.status == 1);
  CHECK_THAT(none.err, Contains("the body is drawn as it touches: not_converged"));
  CHECK_THAT(file_text(scratch / "sphere.svg"), Contains("paper sphere: no answer"));
  CHECK(run_rollres({"draw", example("paper_sphere.json"), "--out", ".."}, evaluate).status == 2);
}
