// Covers local_parabola too.

#include "fitting/errors/profile_likelihood.hpp"

#include "tests/catch.hpp"
#include "tests/fitting/measured_hunter.hpp"

using namespace rollres;

namespace {

constexpr double slope = 2;  // of a resistance by the reciprocal of friction [N/m]

/// A resistance that friction lets rise to 100 N/m, as a straight line in its reciprocal up to a largest one.
Evaluate saturating(double largest_reciprocal) {
  return [largest_reciprocal](const RollingScene& scene) {
    RollingSolution solution;
    solution.rolling_resistance = 100 - slope * std::min(1 / scene.friction_coefficient, largest_reciprocal);
    solution.status = Status::converged;
    return solution;
  };
}

/// The friction of four values with deviations of 1 N/m, two above and two below what friction makes them.
FittedParameter friction_fitted(double friction, double largest_reciprocal = 1e9) {
  const Evaluate evaluate = saturating(largest_reciprocal);
  std::vector<MeasuredScene> scenes;
  for (const double error : {0.5, -0.5, 0.8, -0.8}) {
    RollingScene scene = half_space_scene(1, 1e4);
    scene.friction_coefficient = friction;
    scenes.push_back({scene, {evaluate(scene).rolling_resistance + error, 1, "row"}});
  }
  FitProblem problem = resistance_problem(scenes, {{{"friction_coefficient"}, 0.6}}, evaluate);
  problem.deviations_known = true;
  return fit(problem).parameters[0];
}

constexpr double half = 1.9599640 / (2 * slope);  // of the interval of 1/mu: 1.96 / sqrt(4 slope^2)

}  // namespace

TEST_CASE("the interval of a friction that saturates is that of its reciprocal", "[fitting][profile]") {
  const FittedParameter friction = friction_fitted(0.5);
  CHECK(friction.value == Approx(0.5).epsilon(1e-3));
  const ConfidenceInterval& interval = friction.profile.interval;
  CHECK(interval.lowest == Approx(1 / (2 + half)).epsilon(2e-3));
  CHECK(interval.highest == Approx(1 / (2 - half)).epsilon(2e-3));
  CHECK_FALSE(interval.open());
}

TEST_CASE("a friction that may be any large one has an open interval", "[fitting][profile]") {
  const FittedParameter friction = friction_fitted(2.5);  // 0.4 - 0.49 < 0
  const ConfidenceInterval& interval = friction.profile.interval;
  CHECK(interval.lowest == Approx(1 / (0.4 + half)).epsilon(5e-3));
  CHECK(interval.low == IntervalEnd::closed);
  CHECK(interval.high == IntervalEnd::open);
  CHECK(friction.flag == "not bounded above");
}

TEST_CASE("a friction that may be none has an interval that ends at 0", "[fitting][profile]") {
  const FittedParameter friction = friction_fitted(0.5, 2.2);  // less than 2.2 would take
  CHECK(friction.profile.interval.low == IntervalEnd::limit);
  CHECK(friction.profile.interval.lowest == 0);
  CHECK(friction.profile.interval.highest == Approx(1 / (2 - half)).epsilon(2e-3));
}
