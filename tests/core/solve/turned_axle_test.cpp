#include "core/solve/turned_axle.hpp"

#include <cmath>

#include "core/model/scene_rules.hpp"
#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/core/elastic_half_space.hpp"
#include "tests/core/paper_scenes.hpp"

using namespace rollres;

namespace {

constexpr double degree = M_PI / 180;

RollingScene askew(double angle, double tolerance) {
  RollingScene scene = paper_cylinder();
  scene.kinematics = Kinematics::consistent;
  scene.drive = Drive::free;
  scene.skew_angle = angle;
  scene.spacing.reset();
  scene.tolerance = tolerance;
  return scene;
}

/// A cover on a roller on a hard plane.
RollingScene covered_roller(double angle) {
  RollingScene scene = askew(angle, 1e-3);
  scene.layer_thickness = INFINITY;
  scene.material = MaterialModel::elastic;
  scene.static_shear_modulus = 1e12;
  scene.inertia = Inertia::off;
  scene.radius = 0.05;
  scene.speed = 1;
  scene.load = 8000;
  BondedLayer cover;
  cover.layer_thickness = 0.012;
  cover.static_shear_modulus = 2e6;
  cover.material = MaterialModel::zener;
  cover.stiffening = 1.5;
  cover.creep_time = 5e-3;
  scene.coating_layers = {cover};
  return scene;
}

}  // namespace

TEST_CASE("a cylinder dragged along its axle on an elastic half-space slips as Carter's", "[core][skew]") {
  constexpr double half_width = 1e-3;  // over R: of second order in it are the terms that Carter leaves out
  RollingScene scene = cylinder_on_half_space(half_width, 0.3, Drive::free);
  scene.tolerance = 1e-3;
  for (const double stick : {0.3, 0.6}) {
    scene.skew_angle = std::atan(2 * scene.friction_coefficient * (1 - stick) * half_width);
    const RollingSolution found = solve(scene);
    REQUIRE(found.status == Status::converged);
    const double part = -found.axial_force / (scene.friction_coefficient * *scene.load);
    CHECK(part == Approx(1 - stick * stick).epsilon(1e-5));
    CHECK(found.rolling_resistance == Approx(-std::tan(*scene.skew_angle) * found.axial_force).epsilon(1e-5));
  }
}

TEST_CASE("the paper's cylinder askew takes what another program found", "[core][skew]") {
  // By FFT on uniform cells; its own straight cylinder is 2e-4 off the continuous one.
  struct Known {
    double degrees, torque, resistance, axial;
  };
  for (const Known& known : {Known{0.5, 0, 370.27, 0.138}, Known{1, 0, 384.84, 0.265}, Known{3, 0, 508.9, 0.666},
                             Known{1, 60, 452.4, 0.248}}) {
    CAPTURE(known.degrees, known.torque);
    RollingScene scene = askew(known.degrees * degree, 1e-3);
    if (known.torque > 0) {
      scene.drive = Drive::torque;
      scene.driving_torque = known.torque;
    }
    const RollingSolution found = solve(scene);
    REQUIRE(found.status == Status::converged);
    CHECK(found.rolling_resistance == Approx(known.resistance).epsilon(2e-3));
    CHECK(-found.axial_force / (scene.friction_coefficient * *scene.load) == Approx(known.axial).epsilon(5e-3));
    CHECK(found.energy_residual < 1e-4);
    CHECK(found.skew_angle == Approx(*scene.skew_angle));
    CHECK(found.creepage_y == Approx(-found.rotation_ratio * std::sin(*scene.skew_angle)));
    // Along the travel the resultants make up the resistance as they do of a straight cylinder.
    CHECK(found.driving_force + found.driving_torque * found.rotation_ratio / scene.radius ==
          Approx(found.rolling_resistance).epsilon(1e-6));
  }
}

TEST_CASE("the power of a skewed cylinder's resultants meets its losses to second order in the cell", "[core][skew]") {
  for (const double tolerance : {1e-2, 1e-3, 2e-5}) {
    const RollingSolution found = solve(askew(2 * degree, tolerance));
    REQUIRE(found.status == Status::converged);
    CAPTURE(found.contact_nodes);
    const double cells = 120.0 / found.contact_nodes;
    CHECK(found.energy_residual < 3e-4 * cells * cells);
    CHECK(found.energy_residual > 1e-5 * cells * cells);  // it is no identity
  }
}

TEST_CASE("turned to the other side a cylinder is its own mirror image", "[core][skew]") {
  for (RollingScene scene : {askew(2 * degree, 1e-3), covered_roller(2 * degree)}) {
    const RollingSolution left = solve(scene);
    scene.skew_angle = -2 * degree;
    const RollingSolution right = solve(scene);
    REQUIRE(left.status == Status::converged);
    REQUIRE(right.status == Status::converged);
    CHECK(right.rolling_resistance == Approx(left.rolling_resistance).epsilon(1e-10));
    CHECK(right.axial_force == Approx(-left.axial_force).epsilon(1e-10));
    CHECK(right.creepage_y == Approx(-left.creepage_y).epsilon(1e-10));
  }
}

TEST_CASE("without a skew there is no axial force, and a cylinder that bears none is straight", "[core][skew]") {
  RollingScene scene = askew(0, 1e-4);
  scene.skew_angle.reset();
  const RollingSolution straight = solve(scene);
  scene.axial_force = 0;
  const RollingSolution found = solve(scene);
  REQUIRE(found.status == Status::converged);
  CHECK(found.skew_angle == 0);
  CHECK(found.rolling_resistance == Approx(straight.rolling_resistance).epsilon(2e-5));
  // Without friction only the speed square to the axle counts.
  RollingScene smooth = askew(0.3, 1e-6);
  smooth.friction_coefficient = 0;
  RollingScene slower = smooth;
  slower.skew_angle.reset();
  slower.speed *= std::cos(0.3);
  const RollingSolution sliding = solve(smooth);
  CHECK(sliding.axial_force == 0);
  CHECK(sliding.rolling_resistance == Approx(std::cos(0.3) * solve(slower).rolling_resistance).epsilon(1e-12));
}

TEST_CASE("an axial force that is given finds its skew", "[core][skew]") {
  for (RollingScene scene : {askew(3 * degree, 1e-3), covered_roller(-1 * degree)}) {
    const RollingSolution found = solve(scene);
    REQUIRE(found.status == Status::converged);
    RollingScene back = scene;
    back.skew_angle.reset();
    back.axial_force = found.axial_force;
    const RollingSolution again = solve(back);
    REQUIRE(again.status == Status::converged);
    CHECK(again.skew_angle == Approx(*scene.skew_angle).epsilon(1e-7));
    CHECK(again.rolling_resistance == Approx(found.rolling_resistance).epsilon(1e-7));
    CHECK(again.axial_force == found.axial_force);
    back.width = 0.5;
    *back.load *= 0.5;
    *back.axial_force *= 0.5;
    CHECK(solve(back).rolling_resistance == Approx(0.5 * found.rolling_resistance).epsilon(1e-7));
  }
  RollingScene too_much = askew(0, 1e-3);
  too_much.skew_angle.reset();
  too_much.axial_force = -1.01 * too_much.friction_coefficient * *too_much.load;
  const RollingSolution none = solve(too_much);
  CHECK(none.status == Status::no_steady_state);
  CHECK_THAT(none.reason, Catch::Matchers::Contains("axial_force = -4.04e+03: friction bears 4e+03 N/m"));
}

TEST_CASE("a skewed cylinder's layers may be cut, bent and weighed as a straight one's", "[core][skew]") {
  const auto resistance = [](const RollingScene& scene) {
    const RollingSolution found = solve(scene);
    REQUIRE(found.status == Status::converged);
    return std::array<double, 2>{found.rolling_resistance, found.axial_force};
  };
  const auto same = [](const std::array<double, 2>& a, const std::array<double, 2>& b, double tolerance) {
    CHECK(a[0] == Approx(b[0]).epsilon(tolerance));
    CHECK(a[1] == Approx(b[1]).epsilon(tolerance));
  };
  RollingScene scene = askew(2 * degree, 1e-3);
  scene.inertia = Inertia::off;
  const auto whole = resistance(scene);
  SECTION("cut in two") {
    RollingScene cut = scene;
    BondedLayer lower;
    static_cast<MaterialInputs&>(lower) = cut;
    lower.layer_thickness = 0.6 * cut.layer_thickness;
    cut.layer_thickness *= 0.4;
    cut.lower_layers = {lower};
    same(resistance(cut), whole, 1e-6);
  }
  SECTION("with next to no inertia") {
    RollingScene light = scene;
    light.inertia = Inertia::on;
    light.layer_density = 1e-6;
    same(resistance(light), whole, 2e-4);
  }
  SECTION("a cover cut in two, which has not recovered when it comes round") {
    RollingScene covered = covered_roller(1 * degree);
    covered.coating_layers.front().creep_time = 0.3;
    RollingScene cut = covered;
    cut.coating_layers.push_back(cut.coating_layers.front());
    cut.coating_layers[0].layer_thickness = 0.005;
    cut.coating_layers[1].layer_thickness = 0.007;
    same(resistance(cut), resistance(covered), 1e-6);
  }
}

TEST_CASE("what a skewed cylinder is not solved with is said", "[core][skew]") {
  const auto rule = [](RollingScene scene) {
    const std::vector<std::string> broken = check(scene);
    return broken.empty() ? std::string() : broken.front();
  };
  const RollingScene scene = askew(1 * degree, 1e-3);
  CHECK(rule(scene).empty());
  RollingScene other = scene;
  other.kinematics = Kinematics::printed;
  CHECK_THAT(rule(other), Catch::Matchers::Contains("only with kinematics \"consistent\""));
  other = scene;
  other.axial_force = 10;
  CHECK_THAT(rule(other), Catch::Matchers::Contains("give skew_angle or axial_force, not both"));
  other = scene;
  other.method = Method::spectral;
  CHECK_THAT(rule(other), Catch::Matchers::Contains("skew_angle: not with method \"spectral\" and friction") ||
                              Catch::Matchers::Contains("only with method"));
  other = scene;
  other.skew_angle.reset();
  other.axial_force = 10;
  other.friction_coefficient = 0;
  CHECK_THAT(rule(other), Catch::Matchers::Contains("axial_force = 10: needs a friction_coefficient > 0"));
}
