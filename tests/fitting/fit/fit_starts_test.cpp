#include "fitting/fit/fit_starts.hpp"

#include <atomic>
#include <cmath>
#include <random>

#include "core/material/material.hpp"
#include "fitting/descent/nearest_answer.hpp"
#include "fitting/fit/misfit_cause.hpp"
#include "tests/catch.hpp"
#include "tests/fitting/measured_hunter.hpp"

// Covers nearest_answer, measured_terms, rough_descents, scene_model and misfit_cause, too.

using namespace rollres;

namespace {

FitProblem posed(const std::vector<MeasuredScene>& scenes, const std::vector<FittedInput>& inputs) {
  FitProblem problem = resistance_problem(scenes, inputs, quick_resistance);
  problem.deviations_known = true;
  add_closed_forms(problem, scenes, inputs, "rolling_resistance");
  return problem;
}

std::vector<MeasuredScene> noisy_data() {
  return measured(quick_resistance, spread_speeds(0.003, 3, 12), {1e4, 3e4}, 0.02);
}

}  // namespace

TEST_CASE("a start a hundred times off leads where a near one does, in fewer than 4000 solutions",
          "[fitting][fit_starts]") {
  const auto scenes = noisy_data();
  const FitReport near = fit(posed(scenes, zener_inputs()), {.starts = 4});
  auto inputs = zener_inputs();
  inputs[0].start = 1e8, inputs[1].start = 200, inputs[2].start = 1e-3;
  const FitReport far = fit(posed(scenes, inputs), {.starts = 4});
  CAPTURE(near.evaluations, near.chi_squared, near.noise, near.errors.fall, name_of(near.status));
  CAPTURE(far.evaluations, far.chi_squared, far.noise, far.errors.fall, name_of(far.status), far.reason);
  CHECK(far.evaluations < 4000);
  for (std::size_t j = 0; j < 3; ++j)
    CHECK(std::abs(far.parameters[j].value - near.parameters[j].value) < 0.05 * near.parameters[j].standard_error);
}

namespace {

/// In place of a solver: friction costs up to a third of the resistance, ends to act at 0.2, and the drive needs some
/// of it: 0.0465 for the heaviest load at a friction of 0.0475.
RollingSolution rubbing(const RollingScene& scene) {
  const double friction = scene.friction_coefficient, part = std::min(friction / 0.2, 1.0);
  RollingSolution solution = quick_resistance(scene);
  solution.rolling_resistance *= 1 - part * (1 - part / 2) * scene.speed / (scene.speed + 0.1);
  if (friction < 0.3 * solution.rolling_resistance / *scene.load) {
    solution.status = Status::no_steady_state;
    solution.reason = "the drive asks for more traction than friction can give";
  }
  return solution;
}

FitProblem rubbing_problem(double friction, std::uint64_t seed) {
  std::vector<MeasuredScene> scenes = measured(quick_resistance, spread_speeds(0.003, 3, 10), {1e4, 2e4, 4e4, 8e4});
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  for (MeasuredScene& row : scenes) {
    row.scene.friction_coefficient = friction;
    const double exact = rubbing(row.scene).rolling_resistance;
    row.measured = {exact * (1 + 0.02 * normal(random)), 0.02 * exact, "row"};
  }
  auto inputs = zener_inputs();
  inputs.push_back({{"friction_coefficient"}, 0.5});
  FitProblem problem = resistance_problem(scenes, inputs, rubbing);
  problem.deviations_known = true;
  return problem;
}

}  // namespace

TEST_CASE("friction is found from a start above the one that it ends to act at, and rows without an answer are minded",
          "[fitting][fit_starts]") {
  const FitReport report = fit(rubbing_problem(0.12, 4), {.starts = 4});
  CAPTURE(report.evaluations, report.chi_squared);
  INFO(name_of(report.status) << ": " << report.reason);
  CHECK(report.status >= FitStatus::usable_with_warnings);
  CHECK(report.evaluations < 3000);
  CHECK(std::abs(report.parameters[3].value - 0.12) < 3 * report.parameters[3].standard_error);
}

TEST_CASE("beyond the least friction that the drive bears the answer is that at the least", "[fitting][fit_starts]") {
  const FitProblem problem = rubbing_problem(0.0475, 1), answered = with_nearest_answers(problem, {});
  const FitPoint beyond{1e6, 2, 0.1, 0.03};
  CHECK_FALSE(problem.predict(beyond).found());
  const Prediction there = answered.predict(beyond);
  REQUIRE(there.found());
  FitPoint least = there.taken_at;
  CHECK(least[3] == Approx(0.0467).epsilon(0.005));
  CHECK(problem.predict(least).values == there.values);
  least[3] /= 1.001;
  CHECK_FALSE(problem.predict(least).found());
  CHECK_FALSE(with_nearest_answers(problem, {3}).predict(beyond).found());
  CHECK(answered.predict({1e6, 2, 0.1, 0.06}).taken_at.empty());
}

TEST_CASE("a friction close to what the drive can just bear is found, and its interval ends there",
          "[fitting][fit_starts]") {
  for (const std::uint64_t seed : {1, 2, 3}) {  // the least misfit lies beyond, inside, beyond
    const FitReport report = fit(rubbing_problem(0.0475, seed), {.starts = 4});
    const FittedParameter& friction = report.parameters[3];
    CAPTURE(seed, report.evaluations, report.chi_squared, friction.value, friction.flag);
    INFO(name_of(report.status) << ": " << report.reason);
    CHECK(report.status >= FitStatus::usable_with_warnings);
    CHECK((friction.flag == "at the least value with an answer") == (seed != 2));
    CHECK(friction.profile.interval.low == IntervalEnd::limit);
    CHECK(friction.profile.interval.lowest == Approx(0.0467).epsilon(0.01));
    CHECK(friction.profile.interval.highest > 0.05);
    CHECK(report.parameters[0].profile.interval.lowest < 1.03e6);
    CHECK(report.parameters[0].profile.interval.highest > 1.03e6);
  }
}

TEST_CASE("an offset of the data is named where it is not modelled, and found where it is", "[fitting][fit_starts]") {
  auto scenes = noisy_data();
  for (MeasuredScene& row : scenes) row.measured.value += 100;
  const FitReport without = fit(posed(scenes, zener_inputs()), {.starts = 4});
  CHECK(name_of(without.status) == "MISFIT");
  CHECK_THAT(without.reason, Catch::Contains("an offset"));
  auto inputs = zener_inputs();
  inputs.push_back({{"offset"}});
  const FitReport with = fit(posed(scenes, inputs), {.starts = 4});
  CHECK(with.status >= FitStatus::usable_with_warnings);
  CHECK(std::abs(with.parameters[3].value - 100) < 3 * with.parameters[3].standard_error);
}

TEST_CASE("a prior adds its information, and moduli of the material theirs", "[fitting][fit_starts]") {
  auto scenes = noisy_data();
  auto inputs = zener_inputs();
  const FitReport alone = fit(posed(scenes, inputs), {.profiles = false});
  inputs[0].prior = Prior{.lognormal = true, .mean = 1e6, .deviation = 0.05};
  const FitReport prior = fit(posed(scenes, inputs), {.profiles = false});
  // Information adds: 1/s^2 of the data and of the prior, in the same scaled variable.
  const double before = alone.errors.deviations[0];
  CHECK(prior.errors.deviations[0] == Approx(1 / std::sqrt(1 / (before * before) + 400)).epsilon(0.1));
  CHECK(prior.values.back().measured.prior());

  inputs[0].prior.reset();
  for (const double omega : {1.0, 10.0, 100.0}) {
    MeasuredScene row = scenes.front();
    row.output = storage_modulus_key;
    row.angular_frequency = omega;
    row.measured.value = complex_modulus(row.scene, omega).real();
    row.measured.deviation = 0.01 * row.measured.value;
    scenes.push_back(row);
  }
  const FitReport joint = fit(posed(scenes, inputs), {.profiles = false});
  CHECK(joint.status >= FitStatus::usable_with_warnings);
  for (std::size_t j = 0; j < 3; ++j) CHECK(joint.parameters[j].standard_error < alone.parameters[j].standard_error);
}

TEST_CASE("a fit that its limit or a wish ends says so and has the best so far", "[fitting][fit_starts]") {
  const FitReport limited = fit(posed(noisy_data(), zener_inputs()), {.starts = 4, .limits = {.solutions = 300}});
  CHECK(name_of(limited.status) == "NOT CONVERGED");
  CHECK_THAT(limited.reason, Catch::Contains("solutions_limit = 300"));
  CHECK(std::isfinite(limited.chi_squared));
  const std::atomic<bool> stop = true;
  CHECK_THAT(fit(posed(noisy_data(), zener_inputs()), {.starts = 4, .stop = &stop}).reason,
             Catch::Contains("interrupted"));
}

TEST_CASE("profiles are left out, and named, once a fit has taken the solutions that it is worth",
          "[fitting][fit_starts]") {
  const FitProblem problem = posed(noisy_data(), zener_inputs());
  CHECK(usual_solutions(problem, {}) == 3000);
  CHECK(usual_solutions(problem, {.solutions = 700}) == 700);
  FitReport report = fit(problem, {.starts = 4});
  CHECK(report.enough == 0);
  REQUIRE_FALSE(report.parameters[1].profile.points.empty());
  Descent descent;
  descent.end = report.point();
  descent.prediction = problem.predict(descent.end);
  const Profile none = profile(problem, descent, report.slopes, report.errors, 1, 3.84, nullptr, 0);
  CHECK_FALSE(none.complete);
  report.enough = 3000;
  report.parameters[1].profile = {};
  judge(report, problem);
  CHECK(report.status == FitStatus::usable_with_warnings);
  CHECK_THAT(report.warnings.back() + report.warnings.front(), Catch::Contains("the interval of stiffening is linear"));
}
