// Covers newton_contact, newton_system, newton_starts, rotation_path, friction_limit too.
/// Random scenes (studies/evidence/stability_scene.hpp) on which the Newton method alone finds nothing: contacts that
/// friction draws aside, with several solutions, and bodies on the verge of sliding.

#include <cmath>
#include <string>
#include <vector>

#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"

using namespace rollres;

namespace {

/// One scene; `given` is the driving torque or the rotation ratio.
struct Row {
  double radius, layer_thickness, static_shear_modulus, stiffening, creep_time, speed, load, friction_coefficient,
      spacing;
  Drive drive;
  double given;
  bool resistance_known = true;  // false: less than its error, so that the answer is refused after the contact is found
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
          "[core][newton_robustness][long]") {
  const std::vector<Row> rows{
      // Locked: the solution folds back in the rotation ratio twenty times on the way from rolling.
      {.radius = 0.192,
       .layer_thickness = 0.001524,
       .static_shear_modulus = 6.679e6,
       .stiffening = 7.792,
       .creep_time = 5.969e-5,
       .speed = 0.008551,
       .load = 9.453e5,
       .friction_coefficient = 1.977,
       .spacing = 0.0008113,
       .drive = Drive::rotation,
       .given = 0},
      // The first solution found lies on a part of the path that is folded back.
      {.radius = 0.154,
       .layer_thickness = 0.001423,
       .static_shear_modulus = 2.698e5,
       .stiffening = 2.374,
       .creep_time = 0.01031,
       .speed = 13.99,
       .load = 1.873e7,
       .friction_coefficient = 1.587,
       .spacing = 0.002488,
       .drive = Drive::rotation,
       .given = -18.94},
      // Braked and driven hard.
      {.radius = 0.1361,
       .layer_thickness = 0.001372,
       .static_shear_modulus = 7.192e6,
       .stiffening = 0.3008,
       .creep_time = 0.4285,
       .speed = 4.584,
       .load = 6.253e8,
       .friction_coefficient = 0.5281,
       .spacing = 0.002502,
       .drive = Drive::torque,
       .given = -5.236e7},
      {.radius = 0.09836,
       .layer_thickness = 0.001027,
       .static_shear_modulus = 1.083e5,
       .stiffening = 37.25,
       .creep_time = 0.001479,
       .speed = 3.827,
       .load = 1.953e6,
       .friction_coefficient = 0.484,
       .spacing = 0.00204,
       .drive = Drive::torque,
       .given = -86770},
      {.radius = 0.09339,
       .layer_thickness = 0.00105,
       .static_shear_modulus = 1.239e7,
       .stiffening = 0.392,
       .creep_time = 0.0004821,
       .speed = 9.058,
       .load = 1.373e8,
       .friction_coefficient = 1.214,
       .spacing = 0.00213,
       .drive = Drive::torque,
       .given = -6.337e6},
      {.radius = 0.1686,
       .layer_thickness = 0.001199,
       .static_shear_modulus = 2.409e6,
       .stiffening = 10.17,
       .creep_time = 0.001718,
       .speed = 0.2964,
       .load = 2.056e8,
       .friction_coefficient = 1.008,
       .spacing = 0.002443,
       .drive = Drive::top_force,
       .given = 0,
       .resistance_known = false},
      {.radius = 0.1063,
       .layer_thickness = 0.001699,
       .static_shear_modulus = 1.768e5,
       .stiffening = 44.68,
       .creep_time = 0.01332,
       .speed = 0.0001586,
       .load = 7.093e5,
       .friction_coefficient = 1.033,
       .spacing = 0.001406,
       .drive = Drive::rotation,
       .given = -8.497}};
  for (const Row& row : rows) {
    const RollingScene scene = scene_of(Indenter::cylinder, row);
    if (row.resistance_known)
      check_converged(scene);
    else
      CHECK(solve(scene).reason.find("has an estimated error of") != std::string::npos);
  }
}

TEST_CASE(
    "a body that asks for more than friction can give is refused up to the friction it is said to need, and solved "
    "from there on",
    "[core][newton_robustness][long]") {
  struct Case {
    Indenter indenter;
    Row row;
  };
  const std::vector<Case> cases{// Under twice the friction the body would dig itself in.
                                {Indenter::cylinder,
                                 {.radius = 0.08543,
                                  .layer_thickness = 0.02088,
                                  .static_shear_modulus = 7.406e6,
                                  .stiffening = 24.34,
                                  .creep_time = 0.002696,
                                  .speed = 0.1073,
                                  .load = 1.242e5,
                                  .friction_coefficient = 1.331,
                                  .spacing = 0.0008744,
                                  .drive = Drive::torque,
                                  .given = -16610}},
                                // Friction gives more at some speed of rotation than where everything slides.
                                {Indenter::sphere,
                                 {.radius = 0.141,
                                  .layer_thickness = 0.001379,
                                  .static_shear_modulus = 9.89e5,
                                  .stiffening = 0.03007,
                                  .creep_time = 0.001568,
                                  .speed = 0.002145,
                                  .load = 3e5,
                                  .friction_coefficient = 0.03524,
                                  .spacing = 0.0035,
                                  .drive = Drive::torque,
                                  .given = 900}},
                                {Indenter::sphere,
                                 {.radius = 0.05327,
                                  .layer_thickness = 0.05046,
                                  .static_shear_modulus = 5.296e5,
                                  .stiffening = 10.38,
                                  .creep_time = 0.01209,
                                  .speed = 0.0001376,
                                  .load = 81.1,
                                  .friction_coefficient = 0.005996,
                                  .spacing = 0.00155,
                                  .drive = Drive::torque,
                                  .given = 0.03097}}};
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

TEST_CASE("a contact hundreds of times as long as its layer is thick obeys the laws on any grid",
          "[core][newton_robustness]") {
  // Where nodes are far softer than the contact as a whole, pressures met to 2e-10 left gaps of 1e-7 of its height.
  RollingScene scene = plain_scene();
  scene.indenter = Indenter::cylinder;
  scene.radius = 1.2;
  scene.layer_thickness = 5e-6;
  scene.static_shear_modulus = 30e6;
  scene.stiffening = 0.4;
  scene.creep_time = 4e-5;
  scene.speed = 1e-6;
  scene.friction_coefficient = 0;
  scene.drive = Drive::top_force;
  scene.inertia = Inertia::off;
  scene.load.reset();
  scene.approach = 0.29e-6;
  for (const double spacing : {2e-6, 1.5e-6, 1.3e-6, 1.2e-6}) {
    scene.spacing = spacing;
    check_converged(scene);
  }
}

TEST_CASE("a sphere that slides all over, but not everywhere one way, is solved", "[core][newton_robustness]") {
  check_converged(scene_of(Indenter::sphere, {.radius = 0.006654,
                                              .layer_thickness = 0.004961,
                                              .static_shear_modulus = 9.854e6,
                                              .stiffening = 2.767,
                                              .creep_time = 0.0002309,
                                              .speed = 0.07508,
                                              .load = 54.44,
                                              .friction_coefficient = 0.007082,
                                              .spacing = 0.0002421,
                                              .drive = Drive::torque,
                                              .given = 0.002685}));
}

TEST_CASE("a cylinder that friction makes dig itself in is refused down to the friction that it bears",
          "[core][newton_robustness][long]") {
  RollingScene scene = scene_of(Indenter::cylinder, {.radius = 0.06227,
                                                     .layer_thickness = 0.003358,
                                                     .static_shear_modulus = 1.02e5,
                                                     .stiffening = 0.02917,
                                                     .creep_time = 0.002228,
                                                     .speed = 0.1014,
                                                     .load = 4.699e4,
                                                     .friction_coefficient = 1.853,
                                                     .spacing = 0.001186,
                                                     .drive = Drive::rotation,
                                                     .given = 25.38});
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
