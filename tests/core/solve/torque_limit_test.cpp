#include "core/solve/torque_limit.hpp"

#include <cmath>

#include "core/model/indenter_shape.hpp"
#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/core/paper_scenes.hpp"

using namespace rollres;

TEST_CASE("no locked body turns more torque into friction than the bound", "[core][torque_limit]") {
  for (const Kinematics kinematics : {Kinematics::consistent, Kinematics::printed})
    for (RollingScene scene : {paper_cylinder(), paper_sphere()}) {
      scene.kinematics = kinematics;
      scene.friction_coefficient = 0.1;
      scene.spacing = 0.5e-3;
      scene.drive = Drive::rotation;
      scene.rotation_ratio = 0;
      const RollingSolution sliding = solve(scene);
      INFO(sliding.reason);
      REQUIRE(sliding.status == Status::converged);
      const double torque = std::abs(sliding.driving_torque), most = largest_torque(scene);
      CHECK(torque < most);
      // The bound takes the lever arm where the body is steepest, 5 times its radius, with the printed kinematics all
      // pressure there: a sphere's offset R beside friction's 0.1 R, a cylinder's 0.2 R less 0.1 R lifted by friction.
      const double least = kinematics == Kinematics::consistent ? 0.19
                           : ContactModel(scene).dimension == 3 ? 0.07
                                                                : 0.09;
      CHECK(torque > least * most);
    }
}

TEST_CASE("a torque that friction cannot bear is refused without a solution", "[core][torque_limit]") {
  RollingScene scene = paper_cylinder();
  scene.spacing.reset();
  scene.tolerance = 1e-6;
  scene.drive = Drive::torque;
  for (const double torque : {1e5, -1e5}) {
    scene.driving_torque = torque;
    for (const Kinematics kinematics : {Kinematics::consistent, Kinematics::printed}) {
      scene.kinematics = kinematics;
      const RollingSolution refused = solve(scene);
      CHECK(refused.status == Status::no_steady_state);
      CHECK(refused.reason.find("more torque than friction can give") != std::string::npos);
      CHECK(refused.iterations == 0);
    }
  }
  scene.driving_torque = 60;  // of 80 with every lever arm R
  CHECK(solve(scene).status == Status::converged);
}

TEST_CASE("with printed kinematics a cylinder is refused far more torque than sliding gives", "[core][torque_limit]") {
  RollingScene scene = paper_cylinder();
  scene.spacing.reset();
  scene.drive = Drive::torque;
  scene.kinematics = Kinematics::printed;
  for (const double torque : {300.0, 2e4, -2e4}) {  // the bound without a solution is 2.7e4 N
    scene.driving_torque = torque;
    CHECK(torque < largest_torque(scene));
    const std::string refusal = unbearable_torque(scene);
    CHECK(refusal.find("sliding all over gives 8") != std::string::npos);  // 0.2 of 20 kN/m at 20 mm, 80 N, and more
    CHECK(solve(scene).reason == refusal);
  }
  scene.driving_torque = 90;  // whose refusal is to name the friction needed
  CHECK(unbearable_torque(scene).empty());
  CHECK(solve(scene).friction_needed == Approx(0.224).epsilon(0.01));
}

TEST_CASE("where no bound is certain the torque is left to the solution", "[core][torque_limit]") {
  RollingScene scene = paper_cylinder();
  scene.drive = Drive::torque;
  scene.driving_torque = 1e9;
  CHECK(!unbearable_torque(scene).empty());
  RollingScene pressed = scene;
  pressed.load.reset();
  pressed.approach = 1e-4;
  CHECK(unbearable_torque(pressed).empty());
  RollingScene sticky = scene;
  sticky.adhesion_threshold = 1e5;
  CHECK(unbearable_torque(sticky).empty());
  RollingScene rough = scene;
  rough.friction_coefficient = 0.3;  // at a slope of 5 friction alone lifts the printed cylinder
  CHECK(std::isinf(largest_torque(rough)));
  CHECK(unbearable_torque(rough).find("sliding all over gives") != std::string::npos);
  rough.kinematics = Kinematics::consistent;
  CHECK(!unbearable_torque(rough).empty());
}
