/// A cylinder whose width is given: loads, forces, torques, powers and areas are those of the whole body.

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "core/derivatives/gradient.hpp"
#include "core/model/scene_rules.hpp"
#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/core/paper_scenes.hpp"

using namespace rollres;

namespace {

/// The same contact as a body of this width. @param width [m]; a power of 2, so that no digit is rounded
RollingScene of_width(RollingScene scene, double width) {
  scene.width = width;
  if (scene.load) *scene.load *= width;
  if (scene.driving_torque) *scene.driving_torque *= width;
  return scene;
}

/// Every number of the answer is that of a metre, or so many times it where its unit is per metre.
void check_times(const RollingSolution& body, const RollingSolution& metre, double width) {
  REQUIRE(metre.status == Status::converged);
  REQUIRE(body.status == Status::converged);
  visit_outputs(body, [&](const Quantity& quantity, const auto& value) {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, double>)
      visit_outputs(metre, [&](const Quantity& same, const auto& expected) {
        if constexpr (std::is_same_v<decltype(expected), decltype(value)>)
          if (same.key == quantity.key && same.key != "seconds" && !(std::isnan(value) && std::isnan(expected))) {
            INFO(quantity.key);
            CHECK(value == (quantity.unit_2d.empty() ? 1 : width) * expected);
          }
      });
  });
  CHECK(body.fields.pressure == metre.fields.pressure);
}

}  // namespace

TEST_CASE("a cylinder of width w under w P has w times the forces, torques and powers of a metre, by every method",
          "[core][width]") {
  constexpr double width = 0.25;
  for (const Method method :
       {Method::newton, Method::newton_dense, Method::active_set, Method::spectral, Method::finite_strain}) {
    CAPTURE(name_of(method));
    RollingScene scene = with_method(paper_cylinder(), method);
    if (!on_grid(method)) {
      scene.spacing.reset();
      scene.kinematics = Kinematics::consistent;
    }
    if (method == Method::finite_strain) {
      scene.friction_coefficient = 0;
      scene.tolerance = 1e-2;
    } else if (method == Method::newton) {
      scene.interior = Interior::on;
      scene.drive = Drive::torque;
      scene.driving_torque = 20;
    }
    const RollingSolution metre = solve(scene), body = solve(of_width(scene, width));
    check_times(body, metre, width);
    CHECK(body.load == *scene.load * width);
    CHECK(body.load / body.contact_area == Approx(body.mean_pressure).epsilon(1e-6));  // rounding and the load's own
  }
}

TEST_CASE("at a given approach the width multiplies the load", "[core][width]") {
  RollingScene scene = with_method(paper_cylinder(), Method::spectral);
  scene.spacing.reset();
  scene.load.reset();
  scene.approach = 3e-4;
  check_times(solve(of_width(scene, 4)), solve(scene), 4);
}

TEST_CASE("more width at the same load is less load on each metre", "[core][width][gradient]") {
  // R_r = w r(P/w): d ln R_r / d ln w = 1 - d ln R_r / d ln P.
  RollingScene scene = with_method(paper_cylinder(), Method::spectral);
  scene.spacing.reset();
  scene.kinematics = Kinematics::consistent;
  scene.width = 0.3;
  scene.load = 0.3 * 2e4;
  const Objective f = objective(scene, {{"width"}, {"load"}}, "rolling_resistance", solve);
  const Gradient found = gradient(f, base_point(f), calibrate(f, base_point(f)));
  CHECK(found.inputs[0].elasticity == Approx(1 - found.inputs[1].elasticity).epsilon(1e-6));  // of their steps
  CHECK(found.inputs[0].elasticity < 0);
}

TEST_CASE("a body that is not long beside its contact is warned of", "[core][width]") {
  RollingScene scene = with_method(paper_cylinder(), Method::spectral);
  scene.spacing.reset();
  const auto warned = [&](double width) {
    const std::vector<std::string> warnings = solve(of_width(scene, width)).warnings;
    return std::any_of(warnings.begin(), warnings.end(),
                       [](const std::string& warning) { return warning.starts_with("width = "); });
  };
  CHECK(warned(0.0078125));  // one contact
  CHECK_FALSE(warned(0.0625));
}

TEST_CASE("a width is one of a cylinder alone", "[core][width]") {
  RollingScene sphere = paper_sphere();
  sphere.width = 0.1;
  const std::vector<std::string> broken = check(sphere);
  REQUIRE(broken.size() == 1);
  CHECK(broken.front() ==
        "width = 0.1: only for a cylinder: loads and forces of other bodies are those of the whole body");
  RollingScene cylinder = paper_cylinder();
  cylinder.width = 0;
  CHECK(check(cylinder) == std::vector<std::string>{"width = 0: must be > 0"});
}
