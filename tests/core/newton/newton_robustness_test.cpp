// Covers newton_contact, newton_system, newton_starts, rotation_path, friction_limit too.
/// Random scenes (studies/evidence/stability_scene.hpp) on which the Newton method alone finds nothing: contacts that
/// friction draws aside, with several solutions, and bodies on the verge of sliding.

#include <cmath>
#include <string>
#include <vector>

#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"

using namespace rollres;

namespace {

/// One scene; `given` is the driving torque or the rotation ratio.
struct Row {
  double radius, layer_thickness, static_shear_modulus, stiffening, creep_time, speed, load, friction_coefficient,
      spacing;
  Drive drive;
  double given;
};

RollingScene scene_of(Indenter indenter, const Row& row) {
  RollingScene scene;
  scene.indenter = indenter;
  scene.radius = row.radius;
  scene.layer_thickness = row.layer_thickness;
  scene.static_shear_modulus = row.static_shear_modulus;
  scene.stiffening = row.stiffening;
  scene.creep_time = row.creep_time;
  scene.speed = row.speed;
  scene.load = row.load;
  scene.friction_coefficient = row.friction_coefficient;
  scene.spacing = row.spacing;
  scene.drive = row.drive;
  scene.kinematics = Kinematics::printed;  // with which these rows were found
  if (row.drive == Drive::torque) scene.driving_torque = row.given;
  if (row.drive == Drive::rotation) scene.rotation_ratio = row.given;
  return scene;
}

void check_converged(const RollingScene& scene) {
  const RollingSolution s = solve(scene);
  INFO("friction " << scene.friction_coefficient << ", radius " << scene.radius << ": " << s.reason);
  CHECK(s.status == Status::converged);
  CHECK(s.law_violation < 1e-8);
}

}  // namespace

TEST_CASE("a cylinder whose friction draws a thin layer aside is solved at any rotation and drive",
          "[core][newton_robustness]") {
  const std::vector<Row> rows{
      // Locked: the solution folds back in the rotation ratio twenty times on the way from rolling.
      {0.192, 0.001524, 6.679e6, 7.792, 5.969e-5, 0.008551, 9.453e5, 1.977, 0.0008113, Drive::rotation, 0},
      // The first solution found lies on a part of the path that is folded back.
      {0.154, 0.001423, 2.698e5, 2.374, 0.01031, 13.99, 1.873e7, 1.587, 0.002488, Drive::rotation, -18.94},
      // Braked and driven hard.
      {0.1361, 0.001372, 7.192e6, 0.3008, 0.4285, 4.584, 6.253e8, 0.5281, 0.002502, Drive::torque, -5.236e7},
      {0.09836, 0.001027, 1.083e5, 37.25, 0.001479, 3.827, 1.953e6, 0.484, 0.00204, Drive::torque, -86770},
      {0.09339, 0.00105, 1.239e7, 0.392, 0.0004821, 9.058, 1.373e8, 1.214, 0.00213, Drive::torque, -6.337e6},
      {0.1686, 0.001199, 2.409e6, 10.17, 0.001718, 0.2964, 2.056e8, 1.008, 0.002443, Drive::top_force, 0},
      {0.1063, 0.001699, 1.768e5, 44.68, 0.01332, 0.0001586, 7.093e5, 1.033, 0.001406, Drive::rotation, -8.497}};
  for (const Row& row : rows) check_converged(scene_of(Indenter::cylinder, row));
}

TEST_CASE(
    "a body that asks for more than friction can give is refused up to the friction it is said to need, and solved "
    "from there on",
    "[core][newton_robustness]") {
  struct Case {
    Indenter indenter;
    Row row;
  };
  const std::vector<Case> cases{
      // Under twice the friction the body would dig itself in.
      {Indenter::cylinder,
       {0.08543, 0.02088, 7.406e6, 24.34, 0.002696, 0.1073, 1.242e5, 1.331, 0.0008744, Drive::torque, -16610}},
      // Friction gives most at three times the speed of rolling, more than when everything slides.
      {Indenter::sphere,
       {0.141, 0.001379, 9.89e5, 0.03007, 0.001568, 0.002145, 2.377e6, 0.03524, 0.005751, Drive::torque, 7396}},
      {Indenter::sphere,
       {0.05327, 0.05046, 5.296e5, 10.38, 0.01209, 0.0001376, 81.1, 0.005996, 0.00155, Drive::torque, 0.03097}}};
  for (const Case& one : cases) {
    RollingScene scene = scene_of(one.indenter, one.row);
    const RollingSolution refused = solve(scene);
    REQUIRE(refused.status == Status::no_steady_state);
    for (const double part : {0.98, 0.999}) {
      scene.friction_coefficient = part * refused.friction_needed;
      const RollingSolution s = solve(scene);
      CHECK(s.status == Status::no_steady_state);
      CHECK(s.friction_needed == Approx(refused.friction_needed).epsilon(1e-4));
    }
    for (const double part : {1.001, 1.02}) {
      scene.friction_coefficient = part * refused.friction_needed;
      check_converged(scene);
    }
  }
}

TEST_CASE("a sphere that slides all over, but not everywhere one way, is solved", "[core][newton_robustness]") {
  check_converged(scene_of(Indenter::sphere, {0.006654, 0.004961, 9.854e6, 2.767, 0.0002309, 0.07508, 54.44, 0.007082,
                                              0.0002421, Drive::torque, 0.002685}));
}

TEST_CASE("a cylinder that friction makes dig itself in is refused down to the friction that it bears",
          "[core][newton_robustness]") {
  RollingScene scene = scene_of(Indenter::cylinder, {0.06227, 0.003358, 1.02e5, 0.02917, 0.002228, 0.1014, 4.699e4,
                                                     1.853, 0.001186, Drive::rotation, 25.38});
  const RollingSolution refused = solve(scene);
  REQUIRE(refused.status == Status::no_steady_state);
  CHECK(std::isnan(refused.friction_needed));
  REQUIRE(refused.friction_borne < scene.friction_coefficient);
  CHECK(refused.reason.find("dig") != std::string::npos);
  scene.friction_coefficient = 0.98 * refused.friction_borne;
  check_converged(scene);
  scene.friction_coefficient = 1.02 * refused.friction_borne;
  CHECK(solve(scene).status == Status::no_steady_state);
}
