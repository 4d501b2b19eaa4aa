// Covers motion_rules, too.

// A roller with a crown: contacts longer across the motion than along it, or shorter.

#include <cmath>

#include "core/model/scene_rules.hpp"
#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/core/converged.hpp"
#include "tests/core/paper_scenes.hpp"

using namespace rollres;

namespace {

RollingScene crowned(double transverse_radius, Crown crown = Crown::circle) {
  RollingScene scene = paper_sphere();
  scene.kinematics = Kinematics::consistent;
  scene.indenter = Indenter::roller;
  scene.transverse_radius = transverse_radius;
  scene.crown = crown;
  scene.spacing.reset();
  return scene;
}

}  // namespace

TEST_CASE("a crown of the roller's own radius makes it a sphere", "[core][roller]") {
  RollingScene sphere = crowned(0.02);
  sphere.indenter = Indenter::sphere;
  sphere.transverse_radius.reset();
  const RollingSolution wanted = converged(sphere);
  for (const Crown crown : {Crown::circle, Crown::ellipse}) {
    const RollingSolution found = converged(crowned(0.02, crown));
    CHECK(found.rolling_resistance == Approx(wanted.rolling_resistance).epsilon(1e-9));
    CHECK(found.rotation_ratio == Approx(wanted.rotation_ratio).epsilon(1e-10));
    CHECK(found.approach == Approx(wanted.approach).epsilon(1e-10));
    CHECK(found.contact_nodes == wanted.contact_nodes);
  }
}

TEST_CASE("a crowned roller on an elastic half-space presses as Hertz says of an ellipse", "[core][roller]") {
  // Johnson (1985), section 4.2, with the minor half-axis a, the major b, e^2 = 1 - a^2/b^2, E* = 4 G:
  //   1/2R" = p0/E* a/(e b)^2 (K - E),   1/2R' = p0/E* a/(e b)^2 ((b/a)^2 E - K),   d = p0 a K/E*
  constexpr double modulus = 1e6, minor = 1e-3, largest = 2e4, elastic = 4 * modulus;
  for (const double ratio : {1.7, 4.0})
    for (const bool across : {true, false}) {
      const double major = ratio * minor, e = std::sqrt(1 - 1 / (ratio * ratio));
      const double k = std::comp_ellint_1(e), complete = std::comp_ellint_2(e);
      const double scale = largest / elastic * minor / (e * e * major * major);
      const double flat = 0.5 / (scale * (k - complete)), sharp = 0.5 / (scale * (ratio * ratio * complete - k));
      RollingScene scene = crowned(across ? flat : sharp, Crown::ellipse);
      scene.radius = across ? sharp : flat;
      scene.material = MaterialModel::elastic;
      scene.static_shear_modulus = modulus;
      scene.layer_thickness = INFINITY;
      scene.inertia = Inertia::off;
      scene.friction_coefficient = 0;
      scene.load = 2.0 / 3 * M_PI * minor * major * largest;
      const RollingSolution found = converged(scene);
      INFO(ratio << (across ? " across" : " along") << ", R = " << scene.radius);
      CHECK(found.approach == Approx(largest * minor * k / elastic).epsilon(2e-3));
      CHECK(found.peak_pressure == Approx(largest).epsilon(3e-3));
      CHECK(found.leading_edge == Approx(across ? minor : major).epsilon(5e-3));
      CHECK(found.half_width == Approx(across ? major : minor).epsilon(5e-3));
      CHECK(found.contact_area == Approx(M_PI * minor * major).epsilon(5e-3));
    }
}

TEST_CASE("the middle of a long crown presses as a cylinder", "[core][roller]") {
  // At a given approach the contact is long against its length along the motion and the layer.
  RollingScene line = crowned(0.02);
  line.indenter = Indenter::cylinder;
  line.transverse_radius.reset();
  line.load.reset();
  line.approach = 0.3e-3;
  line.friction_coefficient = 0;  // with it the whole roller decides how fast it turns
  const RollingSolution wanted = converged(line);
  double before = INFINITY;
  for (const double transverse : {0.2, 2.0, 20.0, 200.0}) {
    RollingScene scene = crowned(transverse);
    scene.load.reset();
    scene.approach = line.approach;
    scene.friction_coefficient = 0;
    const RollingSolution found = converged(scene);
    const double apart = std::abs(found.peak_pressure / wanted.peak_pressure - 1);
    INFO(transverse);
    CHECK(apart < before);
    before = apart;
  }
  CHECK(before < 1e-3);
}

TEST_CASE("a cambered crown touches beside the middle as the body of revolution there", "[core][roller]") {
  // Its lowest point lies (R_t - R) sin g from under the middle, and is curved by R_t across and by rho/cos g along the
  // motion, rho = R - R_t + R_t cos g: Hertz's ellipse for those radii.
  constexpr double radius = 0.02, transverse = 0.06, camber = 4 * M_PI / 180;
  const auto pressed = [](RollingScene scene) {
    scene.material = MaterialModel::elastic;
    scene.layer_thickness = INFINITY;
    scene.inertia = Inertia::off;
    scene.friction_coefficient = 0;
    scene.load = 4;
    return converged(scene);
  };
  RollingScene leaning = crowned(transverse);
  leaning.camber_angle = camber;
  RollingScene straight = crowned(transverse, Crown::ellipse);
  straight.radius = (radius - transverse + transverse * std::cos(camber)) / std::cos(camber);
  const RollingSolution found = pressed(leaning), wanted = pressed(straight);
  CHECK(found.approach == Approx(wanted.approach).epsilon(1e-3));
  CHECK(found.peak_pressure == Approx(wanted.peak_pressure).epsilon(2e-3));
  CHECK(found.half_width == Approx(wanted.half_width).epsilon(1e-2));
  const SurfaceGrid& grid = found.fields.grid;
  double force = 0, moment = 0;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      force += found.fields.pressure[static_cast<std::size_t>(grid.index(column, row))];
      moment += grid.y(row) * found.fields.pressure[static_cast<std::size_t>(grid.index(column, row))];
    }
  CHECK(moment / force == Approx(-(transverse - radius) * std::sin(camber)).epsilon(2e-3));
}

TEST_CASE("under camber a crown of the roller's own radius is a cambered sphere", "[core][roller]") {
  RollingScene sphere = crowned(0.02);
  sphere.indenter = Indenter::sphere;
  sphere.transverse_radius.reset();
  sphere.camber_angle = 0.15;
  const RollingSolution wanted = converged(sphere);
  for (const Crown crown : {Crown::circle, Crown::ellipse}) {
    RollingScene scene = crowned(0.02, crown);
    scene.camber_angle = 0.15;
    const RollingSolution found = converged(scene);
    CHECK(found.lateral_force == Approx(wanted.lateral_force).epsilon(1e-6));
    CHECK(found.spin_moment == Approx(wanted.spin_moment).epsilon(1e-6));
    CHECK(found.rolling_resistance == Approx(wanted.rolling_resistance).epsilon(1e-3));  // the sphere's has its edge
  }
}

TEST_CASE("a cambered crowned roller balances its power to second order in the cell", "[core][roller]") {
  for (const Crown crown : {Crown::circle, Crown::ellipse}) {
    RollingScene scene = crowned(0.06, crown);
    scene.drive = Drive::free;
    scene.camber_angle = 0.1;
    scene.skew_angle = 0.02;
    scene.spacing = 0.3e-3;
    const double coarse = converged(scene).energy_residual;
    scene.spacing = 0.15e-3;
    const double fine = converged(scene).energy_residual;
    CHECK(coarse < 1e-2);
    CHECK(fine < 0.5 * coarse);
  }
}

TEST_CASE("a skewed crowned roller balances its power and is its own mirror image", "[core][roller]") {
  RollingScene scene = crowned(0.06);
  scene.drive = Drive::free;
  scene.skew_angle = 0.03;
  const RollingSolution left = converged(scene);
  CHECK(left.energy_residual < 2e-3);
  CHECK(left.lateral_force < 0);
  scene.skew_angle = -0.03;
  const RollingSolution right = converged(scene);
  CHECK(right.rolling_resistance == Approx(left.rolling_resistance).epsilon(1e-9));
  CHECK(right.lateral_force == Approx(-left.lateral_force).epsilon(1e-8));
  CHECK(right.spin_moment == Approx(-left.spin_moment).epsilon(1e-7));
  // What it does not have an answer for is said.
  const auto rule = [](const RollingScene& asked) {
    const std::vector<std::string> broken = check(asked);
    return broken.empty() ? std::string() : broken.front();
  };
  using Catch::Matchers::Contains;
  scene.pivot = 2;
  CHECK_THAT(rule(scene), Contains("pivot = 2: only for a sphere"));
  scene.pivot = 0;
  scene.transverse_radius.reset();
  CHECK_THAT(rule(scene), Contains("transverse_radius: missing") || Contains("indenter \"roller\" needs it"));
}
