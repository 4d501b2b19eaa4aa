#include "core/numerics/halving_limit.hpp"

#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/core/paper_scenes.hpp"

using namespace rollres;

TEST_CASE("changes that halve twice running tell the limit, others tell none", "[core][halving_limit]") {
  // 5 + 3 h + 0.1 h^2 at h = 1, 1/2, 1/4, 1/8
  const auto at = [](double h) { return 5 + 3 * h + 0.1 * h * h; };
  const HalvingLimit first({at(1), at(0.5), at(0.25), at(0.125)});
  CHECK(first.share == 1);
  CHECK(at(0.125) + first.to_come == Approx(5).margin(4e-3));
  CHECK(first.error >= 4e-3);
  // Of second order, without an order, and with a change missing.
  CHECK(HalvingLimit({6.0, 5.25, 5.0625, 5.015625}).share == 0);
  CHECK(HalvingLimit({5.0, 5.1, 4.9, 5.05}).share == 0);
  CHECK(HalvingLimit({5.0, 5.0, 5.0, 5.0}).to_come == 0);
  CHECK(HalvingLimit({5.0, 5.0, 5.1, 5.15}).share == 0);
  // Smooth in between.
  double before = 0;
  for (double ratio = 1.3; ratio < 2; ratio += 0.01) {
    const double share = HalvingLimit({0.0, 1.0, 1 + 1 / ratio, 1 + 1 / ratio + 1 / (ratio * ratio)}).share;
    CHECK(share >= before);
    CHECK(share < before + 0.12);
    before = share;
  }
  CHECK(before == 1);
}

TEST_CASE("a driven cylinder's grid tends to what continuous edges say", "[core][halving_limit]") {
  RollingScene scene = paper_cylinder();
  scene.kinematics = Kinematics::consistent;
  scene.spacing.reset();
  for (const Drive drive : {Drive::free, Drive::top_force, Drive::torque}) {
    scene.drive = drive;
    scene.driving_torque.reset();
    if (drive == Drive::torque) scene.driving_torque = 60;
    scene.method = Method::spectral;
    scene.tolerance = 1e-6;
    const RollingSolution exact = solve(scene);
    scene.method = Method::newton;
    scene.tolerance = 1e-4;
    const RollingSolution found = solve(scene);
    REQUIRE(found.status == Status::converged);
    CAPTURE(static_cast<int>(drive), found.contact_nodes);
    const double error = std::abs(found.rolling_resistance - exact.rolling_resistance);
    CHECK(error < found.rolling_resistance_error);
    CHECK(error < 5e-6 * exact.rolling_resistance);  // the grid alone: 5e-5 to 7e-4
    CHECK(found.rotation_ratio == Approx(exact.rotation_ratio).epsilon(1e-6));
    CHECK(found.driving_force + found.driving_torque * found.rotation_ratio / scene.radius ==
          Approx(found.rolling_resistance).epsilon(1e-9));
  }
}
