/// Bentall and Johnson's rollers: a rigid cylinder that rolls freely on a compressible elastic half-space.

#include <cmath>

#include "core/reference/reference_rollers.hpp"
#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/infinite.hpp"

using namespace rollres;

namespace {

/// As in CONTACT's example; Hertz's half-width is 0.1 mm.
RollingScene free_roller(double friction_coefficient) {
  RollingScene scene;
  scene.radius = 0.025;
  scene.layer_thickness = infinite;
  scene.material = MaterialModel::elastic;
  scene.static_shear_modulus = 15059.0866e6;
  scene.poisson_ratio = 0.41600128;
  scene.speed = 1;
  scene.load = 16201.9;
  scene.friction_coefficient = friction_coefficient;
  scene.drive = Drive::free;
  return scene;
}

}  // namespace

TEST_CASE("a free roller's resistance lies within its error bar, and an elastic half-space takes nothing",
          "[core][rollers]") {
  struct Row {
    double friction, finer;
  };
  // At mu = 1e-4 Newton's iteration stops short from 6,600 nodes on, at 7e-9 of the largest pressure: no finer than
  // that.
  for (const auto& [friction, finer] : {Row{1e-4, 1.5}, {0.01, 4}, {0.05, 4}, {10.0, 4}}) {
    RollingScene scene = free_roller(friction);
    scene.tolerance = 1e-3;
    scene.method = Method::newton;
    const RollingSolution s = solve(scene);
    INFO("mu = " << friction << ", " << s.reason);
    REQUIRE(s.status == Status::converged);
    CHECK(s.contact_nodes < 4000);  // with 1,921 it takes 0.1 s
    scene.tolerance.reset();
    scene.spacing = s.spacing / finer;
    const RollingSolution fine = solve(scene);
    REQUIRE(fine.status == Status::converged);
    INFO("R_r = " << s.rolling_resistance << " +- " << s.rolling_resistance_error << ", finer "
                  << fine.rolling_resistance);
    CHECK(std::abs(s.rolling_resistance - fine.rolling_resistance) <= s.rolling_resistance_error);
    if (friction < 1) {
      CHECK(s.slip_nodes > 0);
      CHECK(s.frictional_loss > 1e-5);
      CHECK(s.rolling_resistance_error < 5e-3 * s.rolling_resistance);  // a bar of use
      CHECK(std::abs(s.viscous_loss) < 1e-3 * s.frictional_loss);
    } else {
      CHECK(s.slip_nodes == 0);
      CHECK(std::abs(s.frictional_loss) <= s.rolling_resistance_error * scene.speed);
      CHECK(std::abs(s.viscous_loss) <= s.rolling_resistance_error * scene.speed);
      CHECK(s.rolling_resistance_error < 1e-9 * *scene.load);
    }
  }
}

TEST_CASE("a free roller's creepage without slip tends to the closed form at first order", "[core][rollers]") {
  RollingScene scene = free_roller(10);
  scene.kinematics = Kinematics::printed;  // the slip of a flat surface
  const NoSlipLine line = no_slip_line(scene.radius, *scene.load, *scene.static_shear_modulus, scene.poisson_ratio);
  const auto solved = [&](int cells) {
    scene.spacing = line.half_width / (cells + 0.5);  // whole cells in contact
    return solve(scene);
  };
  const RollingSolution coarse = solved(240), fine = solved(480);
  const double creepage = 1 - fine.rotation_ratio, before = 1 - coarse.rotation_ratio;
  CHECK(std::abs(creepage / line.creepage - 1) < 0.6 * std::abs(before / line.creepage - 1));
  CHECK(2 * creepage - before == Approx(line.creepage).epsilon(5e-4));  // what is left is of higher order
  CHECK(fine.peak_pressure == Approx(line.mid_pressure).epsilon(2e-4));
}
