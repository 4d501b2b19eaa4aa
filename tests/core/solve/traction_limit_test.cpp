#include <cmath>

#include "core/model/scene_rules.hpp"
#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/core/elastic_half_space.hpp"
#include "tests/core/paper_scenes.hpp"

using namespace rollres;

namespace {

RollingScene consistent(RollingScene scene, std::optional<double> limit) {
  scene.kinematics = Kinematics::consistent;
  scene.method = Method::newton;
  scene.spacing.reset();
  scene.tolerance = dimension_of(scene.indenter) == 3 ? 1e-2 : 1e-4;
  scene.traction_limit = limit;
  return scene;
}

}  // namespace

TEST_CASE("a locked cylinder is dragged by the smaller of Coulomb's shear and the largest", "[core][traction_limit]") {
  // On an incompressible half-space shear leaves Hertz's pressure as it is.
  constexpr double half_width = 1e-3, friction = 0.3;  // a/R: terms of its square are left out
  RollingScene scene = cylinder_on_half_space(half_width, friction, Drive::rotation);
  scene.rotation_ratio = 0;
  scene.tolerance = 1e-4;
  const double peak = 2 * *scene.load / (M_PI * half_width);
  for (const double part : {0.2, 0.6, 0.9, 1.5}) {
    CAPTURE(part);
    scene.traction_limit = part * friction * peak;
    const double flat = part < 1 ? std::sqrt(1 - part * part) : 0, height = std::min(part, 1.0);
    const double force =
        friction * peak * half_width * (2 * height * flat + 0.5 * M_PI - std::asin(flat) - flat * height);
    const RollingSolution found = solve(scene);
    REQUIRE(found.status == Status::converged);
    CHECK(found.driving_force == Approx(force).epsilon(2e-4));
    CHECK(found.peak_shear_x <= *scene.traction_limit * (1 + 1e-9));
    CHECK(found.law_violation < 1e-8);
  }
}

TEST_CASE("a largest shear that nowhere acts changes nothing", "[core][traction_limit]") {
  for (const RollingScene& scene : {paper_cylinder(), paper_sphere()}) {
    const RollingSolution coulomb = solve(consistent(scene, {})), limited = solve(consistent(scene, 1e9));
    CHECK(limited.rolling_resistance == Approx(coulomb.rolling_resistance).epsilon(1e-12));
    CHECK(limited.rotation_ratio == Approx(coulomb.rotation_ratio).epsilon(1e-12));
  }
}

TEST_CASE("driven bodies creep more where the shear is limited, and keep every law", "[core][traction_limit]") {
  for (RollingScene scene : {paper_cylinder(), paper_sphere()}) {
    const bool sphere = dimension_of(scene.indenter) == 3;
    scene.drive = Drive::torque;
    scene.driving_torque = 0.5 * scene.friction_coefficient * *scene.load * scene.radius;
    const RollingSolution coulomb = solve(consistent(scene, {}));
    double creepage = coulomb.rotation_ratio;
    for (const double part : {0.55, 0.45}) {
      const double limit = part * scene.friction_coefficient * coulomb.peak_pressure;
      const RollingSolution found = solve(consistent(scene, limit));
      CAPTURE(sphere, part, found.reason);
      REQUIRE(found.status == Status::converged);
      CHECK(found.peak_shear_x <= limit * (1 + 1e-9));
      CHECK(found.law_violation < 1e-8);
      CHECK(found.energy_residual < (sphere ? 1e-2 : 1e-3));
      CHECK(found.rotation_ratio > creepage);
      creepage = found.rotation_ratio;
    }
  }
  RollingScene askew = consistent(paper_cylinder(), 2e5);
  askew.drive = Drive::free;
  askew.skew_angle = 0.05;
  const RollingSolution found = solve(askew);
  REQUIRE(found.status == Status::converged);
  CHECK(found.peak_shear_y <= 2e5 * (1 + 1e-9));
  CHECK(found.law_violation < 1e-8);
}

TEST_CASE("more than the largest shear gives has no steady state, and methods without it say so",
          "[core][traction_limit]") {
  RollingScene scene = consistent(paper_cylinder(), 1e5);
  scene.drive = Drive::torque;
  scene.driving_torque = 0.8 * scene.friction_coefficient * *scene.load * scene.radius;
  const RollingSolution none = solve(scene);
  CHECK(none.status == Status::no_steady_state);
  CHECK(none.reason == "the drive asks for more traction than friction can give with traction_limit = 1e+05 Pa");
  CHECK(std::isnan(none.friction_needed));
  scene.method = Method::active_set;
  REQUIRE(!check(scene).empty());
  CHECK_THAT(check(scene).front(),
             Catch::Matchers::Contains("traction_limit = 100000: not with method \"active_set\""));
  scene.method = Method::spectral;
  REQUIRE(!check(scene).empty());
  CHECK_THAT(check(scene).front(), Catch::Matchers::Contains("traction_limit = 1e+05: not with method \"spectral\""));
  scene.method = Method::automatic;
  scene.driving_torque = 10;
  CHECK(solve(scene).method == Method::newton);
}
