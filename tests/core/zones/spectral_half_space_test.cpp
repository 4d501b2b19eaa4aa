#include <cmath>

#include "core/reference/reference_hunter.hpp"
#include "tests/core/zones/spectral_scenes.hpp"

using namespace rollres;

namespace {

/// A cylinder on a half-space with the rubbery half-width 1e-5 R, so that its lower surface is a parabola.
RollingScene half_space_scene(double creep_over_half_width, double stiffening) {
  RollingScene scene;
  scene.indenter = Indenter::cylinder;
  scene.radius = 1;
  scene.layer_thickness = INFINITY;
  scene.static_shear_modulus = 1e6;
  scene.stiffening = stiffening;
  scene.creep_time = creep_over_half_width;
  scene.speed = 1e-5;
  scene.load = M_PI * 1e6 * 1e-10;
  return scene;
}

}  // namespace

TEST_CASE("a cylinder on a Zener half-space has Hunter's resistance at any speed", "[core][spectral]") {
  for (const double stiffening : {1.0, 9.0, 99.0})
    for (const double creep : {1e-6, 0.01, 0.1, 0.3, 1.0, 3.0, 10.0, 100.0, 1e6}) {
      RollingScene scene = half_space_scene(creep, stiffening);
      const HunterLine exact =
          hunter_line(scene.radius, *scene.load, *scene.static_shear_modulus, stiffening, creep, 1e-5);
      const RollingSolution solution = spectral(scene);
      CAPTURE(stiffening, creep);
      // Where R_r/P is 1e-6 of the slopes, rounding takes digits.
      CHECK(solution.rolling_resistance ==
            Approx(exact.rolling_resistance).epsilon(creep > 0.001 && creep < 1e4 ? 1e-9 : 1e-8));
      CHECK(solution.leading_edge == Approx(exact.leading_edge()).epsilon(1e-8));
      CHECK(solution.peak_pressure == Approx(exact.peak_pressure).epsilon(1e-6));
    }
}

TEST_CASE("on an elastic half-space tractive rolling is Carter's", "[core][spectral]") {
  RollingScene scene = half_space_scene(0, 0);
  scene.friction_coefficient = 0.3;
  scene.drive = Drive::rotation;
  scene.kinematics = Kinematics::printed;  // slip of a flat surface
  const double stick = 0.6, a = 1e-5;      // a'/a
  for (const double direction : {1.0, -1.0}) {
    scene.rotation_ratio = 1 - direction * 0.3 * a * (1 - stick);
    const RollingSolution solution = spectral(scene);
    // The shear carries a part mu a/R of the load.
    CHECK(solution.driving_torque == Approx(-direction * 0.3 * *scene.load * (1 - stick * stick)).epsilon(1e-5));
    CHECK(solution.contact_area == Approx(2 * a).epsilon(1e-5));
    RollingScene driven = scene;
    driven.drive = Drive::torque;
    driven.rotation_ratio.reset();
    driven.driving_torque = -direction * 0.3 * *scene.load * (1 - stick * stick);
    CHECK((spectral(driven).rotation_ratio - 1) / (*scene.rotation_ratio - 1) == Approx(1).epsilon(2e-5));
  }
}

TEST_CASE("free rolling on an elastic half-space is without shear", "[core][spectral]") {
  RollingScene scene = half_space_scene(0, 0);
  scene.friction_coefficient = 0.3;
  scene.drive = Drive::free;
  scene.kinematics = Kinematics::printed;  // slip of a flat surface
  const RollingSolution solution = spectral(scene);
  CHECK(solution.peak_shear_x < 1e-9 * solution.peak_pressure);
  CHECK(solution.rotation_ratio == Approx(1).epsilon(1e-12));
}
