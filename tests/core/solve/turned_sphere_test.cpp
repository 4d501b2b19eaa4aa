// A sphere whose axle is turned or raised, or which turns along its path: on a whole grid.

#include <array>
#include <cmath>

#include "core/model/scene_rules.hpp"
#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/core/converged.hpp"
#include "tests/core/paper_scenes.hpp"
#include "tests/plain_scene.hpp"

using namespace rollres;

namespace {

constexpr double one_degree = M_PI / 180;

RollingScene turned(double skew, double camber, double pivot) {
  RollingScene scene = free_paper_sphere();
  scene.skew_angle = skew;
  scene.camber_angle = camber;
  scene.pivot = pivot;
  return scene;
}

}  // namespace

TEST_CASE("the paper's sphere with skew, camber or pivot takes what another program found", "[core][turned]") {
  struct Known {
    double skew, camber, pivot, resistance, force, moment, friction;  // [N], [N], [N m], [N]
  };
  for (const Known& known : {Known{1, 0, 0, 3.290, -12.01, 9.92e-3, 0.177},
                             {0, 10, 0, 3.375, 11.78, 33.00e-3, 0.211},
                             {0, 0, 20, 4.196, 20.03, 56.4e-3, 0.849}}) {
    RollingScene scene = turned(known.skew * one_degree, known.camber * one_degree, known.pivot);
    scene.spacing = 0.125e-3;
    const RollingSolution found = converged(scene);
    INFO(known.skew << "° " << known.camber << "° " << known.pivot << " 1/m");
    CHECK(found.rolling_resistance == Approx(known.resistance).epsilon(1e-3));
    CHECK(found.lateral_force == Approx(known.force).epsilon(5e-3));
    CHECK(found.spin_moment == Approx(known.moment).epsilon(5e-3));
    CHECK(found.frictional_loss / scene.speed == Approx(known.friction).epsilon(6e-3));
    CHECK(found.energy_residual < 1e-3);
    const double skew = known.skew * one_degree, camber = known.camber * one_degree, turning = found.rotation_ratio;
    CHECK(found.creepage_x == Approx(1 - turning * std::cos(skew) * std::cos(camber)));
    CHECK(found.creepage_y == Approx(-turning * std::sin(skew) * std::cos(camber)).margin(1e-15));
    CHECK(found.spin == Approx(turning * std::sin(camber) / scene.radius + known.pivot).margin(1e-15));
  }
}

TEST_CASE("the side force of a cambered sphere is a smooth function of the camber where nodes join and leave its edge",
          "[core][turned]") {
  // At 0.212 the edge went on following the pressure as nodes changed, and even cells answered: 1.7 % off.
  RollingScene scene = plain_scene(1, 100);
  scene.indenter = Indenter::sphere;
  scene.radius = 0.05;
  scene.layer_thickness = 0.012;
  scene.static_shear_modulus = 2e6;
  scene.stiffening = 1;
  scene.creep_time = 0.01;
  scene.friction_coefficient = 0.3;
  const auto at = [&](double camber) {
    scene.camber_angle = camber;
    const RollingSolution found = solve(scene);
    REQUIRE(found.status == Status::converged);
    return found;
  };
  const RollingSolution low = at(0.208), middle = at(0.212), high = at(0.216);
  CHECK(middle.lateral_force == Approx(0.5 * (low.lateral_force + high.lateral_force)).epsilon(1e-3));
  CHECK(middle.spin_moment == Approx(0.5 * (low.spin_moment + high.spin_moment)).epsilon(1e-3));
}

TEST_CASE("turned the other way a sphere is its own mirror image", "[core][turned]") {
  const RollingScene scene = turned(2 * one_degree, -8 * one_degree, 12);
  RollingScene other = scene;
  *other.skew_angle *= -1;
  other.camber_angle *= -1;
  other.pivot *= -1;
  const RollingSolution left = converged(scene), right = converged(other);
  CHECK(right.rolling_resistance == Approx(left.rolling_resistance).epsilon(1e-10));
  CHECK(right.lateral_force == Approx(-left.lateral_force).epsilon(1e-9));
  CHECK(right.spin_moment == Approx(-left.spin_moment).epsilon(1e-9));
  CHECK(right.overturning_moment == Approx(-left.overturning_moment).epsilon(1e-9));
  const SurfaceGrid& grid = left.fields.grid;
  REQUIRE(right.fields.grid.rows == grid.rows);
  double largest = 0;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const auto at = static_cast<std::size_t>(grid.index(column, row)),
                 image = static_cast<std::size_t>(grid.index(column, grid.rows - 1 - row));
      largest = std::max(largest, std::abs(left.fields.shear_y[at] + right.fields.shear_y[image]));
    }
  CHECK(largest < 1e-8 * left.peak_shear_y);
}

TEST_CASE("a sphere under camber is the straight one with as much spin", "[core][turned]") {
  constexpr double camber = 10 * one_degree, turning = 1.05;
  RollingScene leaning = turned(0, camber, 0), pivoting = turned(0, 0, turning * std::sin(camber) / 0.02);
  for (RollingScene* const scene : {&leaning, &pivoting}) scene->drive = Drive::rotation;
  leaning.rotation_ratio = turning;
  pivoting.rotation_ratio = turning * std::cos(camber);
  const RollingSolution one = converged(leaning), other = converged(pivoting);
  CHECK(one.rolling_resistance == Approx(other.rolling_resistance).epsilon(1e-10));
  CHECK(one.lateral_force == Approx(other.lateral_force).epsilon(1e-10));
  CHECK(one.spin_moment == Approx(other.spin_moment).epsilon(1e-10));
  CHECK(one.spin == Approx(other.spin).epsilon(1e-12));
}

TEST_CASE("without an angle the whole grid answers as the folded one", "[core][turned]") {
  const RollingSolution straight = converged(free_paper_sphere());
  CHECK(std::isnan(straight.lateral_force));
  const RollingSolution whole = converged(turned(1e-13, 0, 0));
  CHECK(whole.rolling_resistance == Approx(straight.rolling_resistance).epsilon(1e-9));
  CHECK(whole.rotation_ratio == Approx(straight.rotation_ratio).epsilon(1e-7));
  CHECK(whole.contact_nodes == straight.contact_nodes);
  CHECK(std::abs(whole.lateral_force) < 1e-8);
  const RollingSolution asked = converged(turned(0, 0, 0));
  CHECK(asked.rolling_resistance == straight.rolling_resistance);
  CHECK(asked.lateral_force == 0);
  CHECK(asked.skew_angle == 0);
}

TEST_CASE("a lateral force that is given finds its skew, beside any camber", "[core][turned]") {
  for (RollingScene scene : {turned(1.5 * one_degree, 0, 0), turned(-1 * one_degree, 6 * one_degree, 0)}) {
    scene.spacing = 0.4e-3;
    const RollingSolution found = converged(scene);
    RollingScene back = scene;
    back.skew_angle.reset();
    back.lateral_force = found.lateral_force;
    const RollingSolution again = converged(back);
    CHECK(again.skew_angle == Approx(*scene.skew_angle).epsilon(1e-6));
    CHECK(again.rolling_resistance == Approx(found.rolling_resistance).epsilon(1e-8));
    CHECK(again.lateral_force == found.lateral_force);
  }
  RollingScene too_much = turned(0, 0, 0);
  too_much.skew_angle.reset();
  too_much.spacing = 0.4e-3;
  too_much.lateral_force = 40;
  CHECK_THAT(solve(too_much).reason, Catch::Matchers::Contains("lateral_force = 40: friction bears "));
}

TEST_CASE("small creepages and spin of a sphere on an elastic half-space meet Kalker's coefficients",
          "[core][turned]") {
  // At a = b, nu = 1/2, extrapolated by another program: C22 3.989, C23 1.634, C33 1.165. One body yields alone, which
  // doubles the modulus. Slip leaves the first order: mu is large.
  constexpr double radius = 1, half_width = 2e-3, modulus = 1e6, small = 1e-6;
  RollingScene scene = free_paper_sphere();
  scene.material = MaterialModel::elastic;
  scene.static_shear_modulus = modulus;
  scene.layer_thickness = INFINITY;
  scene.inertia = Inertia::off;
  scene.radius = radius;
  scene.load = 16 * modulus * std::pow(half_width, 3) / (3 * radius);
  scene.friction_coefficient = 5;
  scene.drive = Drive::rotation;
  scene.rotation_ratio = 1;
  constexpr double scale = 2 * modulus * half_width * half_width * small;
  scene.spacing = half_width / 34;
  scene.skew_angle = -small;
  CHECK(converged(scene).lateral_force / scale == Approx(3.989).epsilon(3e-3));
  scene.skew_angle.reset();
  scene.pivot = small / half_width;
  const RollingSolution spun = converged(scene);
  CHECK(spun.lateral_force / scale == Approx(1.634).epsilon(1e-2));
  CHECK(spun.spin_moment / (scale * half_width) == Approx(1.165).epsilon(4e-3));
}

TEST_CASE("what a turned body is not solved with is said", "[core][turned]") {
  const auto rule = [](const RollingScene& scene) {
    const std::vector<std::string> broken = check(scene);
    return broken.empty() ? std::string() : broken.front();
  };
  using Catch::Matchers::Contains;
  RollingScene scene = turned(1 * one_degree, 0, 0);
  CHECK(rule(scene).empty());
  RollingScene other = scene;
  other.lateral_force = 1;
  CHECK_THAT(rule(other), Contains("lateral_force = 1: give skew_angle or lateral_force, not both"));
  other = scene;
  other.axial_force = 1;
  other.skew_angle.reset();
  CHECK_THAT(rule(other), Contains("axial_force = 1: only for a cylinder"));
  other = scene;
  other.kinematics = Kinematics::printed;
  CHECK_THAT(rule(other), Contains("only with kinematics \"consistent\""));
  other = scene;
  other.coating_layers.emplace_back().layer_thickness = 1e-3;
  other.coating_layers[0].static_shear_modulus = 1e6;
  other.coating_layers[0].material = MaterialModel::elastic;
  CHECK_THAT(rule(other), Contains("not with a coating and friction"));
  other = scene;
  other.interior = Interior::on;
  CHECK(rule(other).empty());
  other = paper_cylinder();
  other.pivot = 3;
  CHECK_THAT(rule(other), Contains("pivot = 3: only for a sphere"));
  other.pivot = 0;
  other.camber_angle = 0.1;
  CHECK_THAT(rule(other), Contains("camber_angle = 0.1: only for a sphere or roller"));
}
