/// What drives the body, given one way or another, and the limits of friction.

#include <algorithm>
#include <cmath>
#include <string>

#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/core/paper_scenes.hpp"

using namespace rollres;

namespace {

void check_same(const RollingSolution& got, const RollingSolution& expected) {
  REQUIRE(got.status == Status::converged);
  CHECK(got.law_violation < 1e-8);
  // The laws hold to 2e-10 of the largest pressure; sums over nodes to a few times that.
  CHECK(got.rolling_resistance == Approx(expected.rolling_resistance).epsilon(1e-8));
  CHECK(got.rotation_ratio == Approx(expected.rotation_ratio).epsilon(1e-8));
  CHECK(got.approach == Approx(expected.approach).epsilon(1e-8));
  CHECK(got.load == Approx(expected.load).epsilon(1e-8));
  CHECK(got.contact_nodes == expected.contact_nodes);
  CHECK(got.slip_nodes == expected.slip_nodes);
  CHECK(got.peak_pressure == Approx(expected.peak_pressure).epsilon(1e-8));
}

double lowest_pressure(const RollingSolution& s) {
  return *std::min_element(s.fields.pressure.begin(), s.fields.pressure.end());
}

}  // namespace

TEST_CASE("the torque, rotation or approach that a solution found, given in its place, gives that solution",
          "[core][drives]") {
  for (const RollingScene& scene : {paper_cylinder(), paper_sphere()}) {
    const RollingSolution s = solve(scene);
    REQUIRE(s.status == Status::converged);
    RollingScene given = scene;
    given.drive = Drive::torque;
    given.driving_torque = s.driving_torque;
    check_same(solve(given), s);
    given = scene;
    given.drive = Drive::rotation;
    given.rotation_ratio = s.rotation_ratio;
    check_same(solve(given), s);
    given = scene;
    given.load.reset();
    given.approach = s.approach;
    check_same(solve(given), s);
  }
}

TEST_CASE("each drive does what it says, and the resistance is the power of force and torque over speed",
          "[core][drives]") {
  for (RollingScene scene : {paper_cylinder(), paper_sphere()}) {
    const double scale = *scene.load * scene.radius;
    const auto balanced = [&](const RollingSolution& s) {
      REQUIRE(s.status == Status::converged);
      CHECK(s.law_violation < 1e-8);
      CHECK(s.rolling_resistance ==
            Approx(s.driving_force + s.driving_torque * s.rotation_speed / scene.speed).epsilon(1e-12));
      CHECK(s.rotation_ratio == Approx(scene.radius * s.rotation_speed / scene.speed).epsilon(1e-12));
    };
    RollingSolution s = solve(scene);
    balanced(s);
    CHECK(std::abs(s.driving_torque - s.driving_force * scene.radius) < 1e-8 * scale);
    scene.drive = Drive::free;
    s = solve(scene);
    balanced(s);  // R_r is computed with the torque that the tractions have
    CHECK(s.driving_torque == 0);
    scene.drive = Drive::torque;
    for (const double share : {-0.7, 0.3}) {
      scene.driving_torque = share * scene.friction_coefficient * scale;
      s = solve(scene);
      balanced(s);
      CHECK(std::abs(s.driving_torque - *scene.driving_torque) < 1e-8 * scale);
      CHECK(std::signbit(s.rotation_ratio - 1.02) == (share < 0));  // braked: slower than free rolling
    }
    scene.driving_torque.reset();
    scene.drive = Drive::rotation;
    for (const double ratio : {-1.0, 0.0, 0.99, 1.05, 2.0}) {
      scene.rotation_ratio = ratio;
      s = solve(scene);
      balanced(s);
      CHECK(s.rotation_ratio == ratio);
    }
  }
}

TEST_CASE("a locked body slides everywhere and is dragged by friction", "[core][drives]") {
  RollingScene scene = paper_sphere();
  scene.drive = Drive::rotation;
  scene.rotation_ratio = 0;
  RollingSolution s = solve(scene);
  REQUIRE(s.status == Status::converged);
  CHECK(s.slip_nodes == s.contact_nodes);
  CHECK(s.rotation_speed == 0);
  // Horizontal forces: Q = mu P but for the slip's small component across; in three dimensions nodal forces are
  // vertical and horizontal.
  CHECK(s.driving_force == Approx(0.2 * 150).epsilon(1e-4));
  CHECK(s.rolling_resistance == Approx(s.driving_force).epsilon(1e-12));

  scene = paper_cylinder();
  scene.drive = Drive::rotation;
  scene.rotation_ratio = 0;
  s = solve(scene);
  REQUIRE(s.status == Status::converged);
  CHECK(s.slip_nodes == s.contact_nodes);
  // In two dimensions they are normal and tangential: friction and the pressure's horizontal part, whose lever is x/R.
  double ploughing = 0;
  for (int i = 0; i < s.fields.grid.size(); ++i)
    ploughing += s.spacing * s.fields.pressure[static_cast<std::size_t>(i)] * s.fields.grid.x(i) / scene.radius;
  CHECK(ploughing > 0);
  CHECK(s.driving_force == Approx(0.2 * s.load + ploughing).epsilon(0.01));  // (mu x/R) of the load's tilt
}

TEST_CASE("with much friction nothing slips, however much more there is", "[core][drives]") {
  for (RollingScene scene : {paper_cylinder(), paper_sphere()}) {
    scene.friction_coefficient = 1e3;
    const RollingSolution s = solve(scene);
    REQUIRE(s.status == Status::converged);
    CHECK(s.law_violation < 1e-8);
    CHECK(s.slip_nodes == 0);
    // What is released where the last node leaves the contact, as the shear is singular there.
    CHECK(s.frictional_loss >= 0);
    CHECK(s.frictional_loss < 0.03 * s.rolling_resistance * scene.speed);
    scene.friction_coefficient = 1e6;
    check_same(solve(scene), s);
  }
}

TEST_CASE("the smallest friction that lets a body roll is the one that the refusal states", "[core][drives]") {
  for (RollingScene scene : {paper_cylinder(), paper_sphere()}) {
    if (scene.indenter == Indenter::sphere) scene.spacing = 0.5e-3;
    // Bisection in the friction coefficient by status alone.
    double refused = 0.002, rolls = 0.05;
    double stated = 0;
    while (rolls / refused > 1.001) {
      scene.friction_coefficient = std::sqrt(refused * rolls);
      const RollingSolution s = solve(scene);
      INFO("friction " << scene.friction_coefficient << ": " << s.reason);
      if (s.status == Status::converged) {
        CHECK(s.law_violation < 1e-8);
        rolls = scene.friction_coefficient;
      } else {
        REQUIRE(s.status == Status::no_steady_state);
        refused = scene.friction_coefficient;
        stated = s.friction_needed;
        CHECK(s.reason.find("friction") != std::string::npos);
      }
    }
    if (scene.indenter == Indenter::cylinder)
      CHECK(rolls == Approx(0.009).epsilon(0.02));  // Q = R_r/2 through friction
    CHECK(stated == Approx(rolls).epsilon(0.002));
  }
}

TEST_CASE("more torque than friction bears is refused, a little less is not", "[core][drives]") {
  RollingScene scene = paper_cylinder();
  scene.drive = Drive::torque;
  // The pressure's sum is the load times 1 + O((a/R)^2): 2 % leaves room for it.
  for (const double sign : {1.0, -1.0}) {
    scene.driving_torque = sign * 1.05 * scene.friction_coefficient * *scene.load * scene.radius;
    const RollingSolution refused = solve(scene);
    CHECK(refused.status == Status::no_steady_state);
    CHECK(refused.reason.find("friction") != std::string::npos);
    scene.driving_torque = sign * 0.97 * scene.friction_coefficient * *scene.load * scene.radius;
    const RollingSolution rolls = solve(scene);
    CHECK(rolls.status == Status::converged);
    CHECK(rolls.law_violation < 1e-8);
  }
}

TEST_CASE("a rolling contact peels: its nodes let go at the adhesion threshold, not before", "[core][drives]") {
  for (const RollingScene& paper : {paper_cylinder(), paper_sphere()})
    for (const bool rough : {true, false}) {
      RollingScene scene = rough ? paper : frictionless(paper);
      int nodes = solve(scene).contact_nodes;
      for (const double threshold : {1e5, 1e6}) {
        scene.adhesion_threshold = threshold;
        const RollingSolution s = solve(scene);
        INFO(name_of(scene.indenter) << (rough ? ", friction, " : ", frictionless, ") << threshold << " Pa");
        REQUIRE(s.status == Status::converged);
        CHECK(s.law_violation < 1e-8);
        CHECK(lowest_pressure(s) >= -threshold * (1 + 1e-8));
        CHECK(s.contact_nodes >= nodes);
        nodes = s.contact_nodes;
      }
      INFO(name_of(scene.indenter) << (rough ? ", friction" : ", frictionless"));
      // The widest contact that the threshold bears: with one more node the tension would pass 1 MPa, and it changes by
      // about half that from node to node.
      CHECK(lowest_pressure(solve(scene)) < -0.5e6);
    }
}

TEST_CASE("only ratios matter: lengths, stresses and times scale away", "[core][drives]") {
  // What differs is where the iteration stops, within 2e-10 of the largest pressure.
  const double same = 1e-9;
  for (const RollingScene& scene : {paper_cylinder(), paper_sphere()}) {
    const double length = 7, stress = 11, time = 0.3;
    RollingScene scaled = scene;
    scaled.radius *= length;
    scaled.layer_thickness *= length;
    *scaled.spacing *= length;
    *scaled.static_shear_modulus *= stress;
    scaled.creep_time *= time;
    scaled.speed *= length / time;
    const double force = stress * (scene.indenter == Indenter::sphere ? length * length : length);
    *scaled.load *= force;
    const RollingSolution a = solve(scene), b = solve(scaled);
    REQUIRE(b.status == Status::converged);
    CHECK(b.contact_nodes == a.contact_nodes);
    CHECK(b.slip_nodes == a.slip_nodes);
    CHECK(b.rolling_resistance == Approx(force * a.rolling_resistance).epsilon(same));
    CHECK(b.rotation_ratio == Approx(a.rotation_ratio).epsilon(same));
    CHECK(b.approach == Approx(length * a.approach).epsilon(same));
    CHECK(b.driving_torque == Approx(force * length * a.driving_torque).epsilon(same));
    CHECK(b.viscous_loss == Approx(force * length / time * a.viscous_loss).epsilon(same));
    CHECK(b.peak_pressure == Approx(stress * a.peak_pressure).epsilon(same));
  }
}

TEST_CASE("a train of bodies far apart rolls like a single one", "[core][drives]") {
  // e^{-L/(V tau)} = 1e-7 at the paper's L = 0.2 m; its 2000 terms leave 1e-5 of the loaded cell's own response.
  RollingScene scene = paper_cylinder();
  const RollingSolution single = solve(scene);
  scene.period = 0.2;
  const RollingSolution train = solve(scene);
  REQUIRE(train.status == Status::converged);
  CHECK(train.contact_nodes == single.contact_nodes);
  CHECK(train.rolling_resistance == Approx(single.rolling_resistance).epsilon(2e-5));
}
