// Rollers whose profile along the axle is given by points.

#include <algorithm>
#include <cmath>

#include "core/model/scene_rules.hpp"
#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/core/converged.hpp"
#include "tests/core/paper_scenes.hpp"

using namespace rollres;
using Catch::Matchers::Contains;

namespace {

constexpr double reach = 9.8e-3;

RollingScene free_roller() {
  RollingScene scene = free_paper_sphere();
  scene.spacing.reset();
  return scene;
}

template <class Height>
RollingScene profiled(const Height& height, double moved = 0) {
  RollingScene scene = free_roller();
  scene.indenter = Indenter::profile;
  constexpr int points = 150;
  for (int i = -points; i <= points; ++i) {
    const double y = reach * i / points;
    scene.profile_places.push_back(y + moved);
    scene.profile_heights.push_back(height(y));
  }
  return scene;
}

double arc(double y, double radius) { return y * y / (radius + std::sqrt(radius * radius - y * y)); }

/// Straight in the middle, with rounded ends.
double rounded(double y) {
  constexpr double straight = 4e-3, end = 6e-3;
  return arc(std::max(std::abs(y) - straight, 0.0), end);
}

/// Higher to the left, and no mirror image of itself.
double conical(double y) { return rounded(y) + 0.01 * y; }

std::string rule(const RollingScene& scene) {
  const std::vector<std::string> broken = check(scene);
  return broken.empty() ? std::string() : broken.front();
}

}  // namespace

TEST_CASE("a profile that follows a crown rolls as that crown, straight, skewed and cambered", "[core][roller]") {
  constexpr double transverse = 0.06;
  for (const auto& [skew, camber] : {std::pair{0.0, 0.0}, std::pair{0.02, 0.0}, std::pair{0.0, 0.03}}) {
    RollingScene crown = free_roller(), scene = profiled([](double y) { return arc(y, transverse); });
    crown.indenter = Indenter::roller;
    crown.transverse_radius = transverse;
    for (RollingScene* each : {&crown, &scene}) {
      if (skew != 0) each->skew_angle = skew;
      each->camber_angle = camber;
      each->load = 30;  // ends clear of the layer
    }
    const RollingSolution wanted = converged(crown), found = converged(scene);
    INFO(skew << " " << camber);
    // The straight crown has its edge inside the cells, the profile on their borders.
    CHECK(found.rolling_resistance == Approx(wanted.rolling_resistance).epsilon(2e-3));
    CHECK(std::abs(found.rolling_resistance - wanted.rolling_resistance) <
          found.rolling_resistance_error + wanted.rolling_resistance_error);
    CHECK(found.approach == Approx(wanted.approach).epsilon(1e-3));
    if (skew != 0 || camber != 0) CHECK(found.lateral_force == Approx(wanted.lateral_force).epsilon(5e-3));
  }
}

TEST_CASE("a profile moved along the axle rolls as before, pushed about the middle by its arm", "[core][roller]") {
  // Half a grid against a whole one, with every place and moment of it.
  constexpr double moved = 3e-3;
  const RollingSolution middle = converged(profiled(rounded)), aside = converged(profiled(rounded, moved));
  CHECK(aside.rolling_resistance == Approx(middle.rolling_resistance).epsilon(1e-4));
  CHECK(aside.approach == Approx(middle.approach).epsilon(1e-6));
  // The left one of two mirror images, or either.
  CHECK(std::abs(aside.peak_pressure_y - moved) == Approx(middle.peak_pressure_y).margin(2 * aside.spacing));
  CHECK(std::abs(aside.lateral_force) < 1e-6 * *free_roller().load);
  CHECK(aside.overturning_moment == Approx(-moved * aside.load).epsilon(1e-3));
}

TEST_CASE("a mirrored profile has the mirrored answer", "[core][roller]") {
  const RollingSolution left = converged(profiled(conical)),
                        right = converged(profiled([](double y) { return conical(-y); }));
  CHECK(right.rolling_resistance == Approx(left.rolling_resistance).epsilon(1e-8));
  CHECK(right.lateral_force == Approx(-left.lateral_force).margin(1e-7 * left.load));
  CHECK(right.spin_moment == Approx(-left.spin_moment).epsilon(1e-6));
  CHECK(left.spin_moment != 0);
  CHECK(right.peak_pressure_y == Approx(-left.peak_pressure_y).epsilon(1e-9));
  CHECK(left.peak_pressure_y < 0);  // where the cone is widest
}

TEST_CASE("between its rounded ends a long straight roller presses as a cylinder, and more beside them",
          "[core][roller]") {
  RollingScene line = free_roller();
  line.indenter = Indenter::cylinder;
  line.friction_coefficient = 0;
  line.load.reset();
  line.approach = 0.2e-3;
  const RollingSolution wanted = converged(line);
  RollingScene scene = profiled([](double y) { return arc(std::max(std::abs(6 * y) - 0.04, 0.0), 0.04); });
  for (double& place : scene.profile_places) place *= 6;
  scene.friction_coefficient = 0;
  scene.load.reset();
  scene.approach = line.approach;
  const RollingSolution found = converged(scene);
  const SurfaceGrid& grid = found.fields.grid;
  double of_middle = 0;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      if (std::abs(grid.y(row)) < 0.01)
        of_middle = std::max(of_middle, found.fields.pressure[static_cast<std::size_t>(grid.index(column, row))]);
  CHECK(of_middle == Approx(wanted.peak_pressure).epsilon(5e-3));
  CHECK(found.peak_pressure > of_middle);
  CHECK(found.half_width > 0.04);
  CHECK(found.half_width < 0.05);
}

TEST_CASE("the stated errors of a grooved profile hold its resistance on a finer grid", "[core][roller]") {
  const auto groove = [](double y) {
    const double d = std::abs(std::abs(y) - 1.5e-3) / 0.6e-3;
    return rounded(y) + (d < 1 ? 0.2e-3 * (1 + std::cos(M_PI * d)) : 0);
  };
  RollingScene scene = profiled(groove);
  const RollingSolution usual = converged(scene);
  scene.spacing = 0.1e-3;
  const RollingSolution fine = converged(scene);
  CHECK(std::abs(usual.rolling_resistance - fine.rolling_resistance) <
        usual.rolling_resistance_error + fine.rolling_resistance_error);
  CHECK(usual.error_estimate < 2e-2);
  CHECK(usual.spacing < 0.25e-3);  // the grooves have cells of their own
}

TEST_CASE("a contact that reaches the end of its profile has no answer, and says why", "[core][roller]") {
  RollingScene scene = profiled([](double y) { return arc(0.3 * y, 0.06); });
  for (double& place : scene.profile_places) place *= 0.3;
  const RollingSolution found = solve(scene);
  CHECK(found.status == Status::not_converged);
  CHECK_THAT(found.reason, Contains("the contact reaches the end of the profile near y = "));
  CHECK_THAT(found.reason, Contains("must go on to where the body has left the layer"));
}

TEST_CASE("a profile that is none is refused by name", "[core][roller]") {
  const RollingScene good = profiled(rounded);
  CHECK(rule(good).empty());
  RollingScene scene = good;
  scene.profile_places.clear();
  CHECK_THAT(rule(scene), Contains("profile_places is missing: indenter \"profile\" needs it, or profile_file"));
  scene = good;
  scene.profile_heights.pop_back();
  CHECK_THAT(rule(scene), Contains("profile_heights: must have as many numbers as profile_places, 301; has 300"));
  scene = good;
  scene.profile_places = {0};
  scene.profile_heights = {0};
  CHECK_THAT(rule(scene), Contains("profile_places: must have two numbers at least"));
  scene = good;
  scene.profile_places[7] = scene.profile_places[6];
  CHECK_THAT(rule(scene), Contains("profile_places[7] = ") && Contains("must rise from one to the next"));
  scene = good;
  scene.profile_heights.back() = 0.03;
  CHECK_THAT(rule(scene), Contains("profile_heights: must rise by less than the radius, 0.02 m; they rise by 0.03 m"));
  scene = good;
  scene.indenter = Indenter::sphere;
  CHECK_THAT(rule(scene), Contains("profile_places: only with indenter \"profile\""));
  scene = profiled(conical);
  scene.interior = Interior::on;
  CHECK(rule(scene).empty());
  scene = good;
  scene.interior = Interior::on;
  CHECK(rule(scene).empty());
  scene.friction_coefficient = 0;
  scene.drive = Drive::top_force;
  scene.skew_angle = 0.1;
  CHECK(rule(scene).empty());
  scene = good;
  scene.kinematics = Kinematics::printed;
  CHECK_THAT(rule(scene), Contains("indenter = profile: only with kinematics \"consistent\""));
  scene = good;
  scene.profile_heights[150] = 5e-3;
  scene.camber_angle = 1.2;
  CHECK_THAT(rule(scene), Contains("camber_angle = 1.2: hides the profile behind its rim at y = "));
}
