#include "fitting/fit/coverage.hpp"

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "fitting/fit/experiment_design.hpp"
#include "tests/catch.hpp"
#include "tests/fitting/measured_hunter.hpp"

using namespace rollres;

namespace {

/// 15 speeds and 2 loads, with a deviation of 2 %.
std::vector<MeasuredScene> thirty_values() {
  return measured(quick_resistance, spread_speeds(0.005, 5, 15), {1e4, 4e4});
}

}  // namespace

TEST_CASE("95 % intervals of 200 noisy data sets hold the truth in 90 to 98 %", "[fitting][coverage][long]") {
  // A quick closed form in place of the solver. 3 sigma of a count of 200 at 95 % is 4.6 %.
  FitProblem problem = resistance_problem(thirty_values(), zener_inputs(), quick_resistance, {.jobs = 1});
  for (const bool known : {true, false}) {
    problem.deviations_known = known;
    const Coverage counted = coverage(problem, {1e6, 2, 0.1}, 1, {.draws = 200, .seed = 11, .profiles = true});
    CHECK(counted.draws == 200);
    CHECK(counted.fitted >= 198);
    for (const ParameterCoverage& parameter : counted.parameters) {
      CHECK(parameter.linear >= 0.90 * counted.fitted);
      CHECK(parameter.linear <= 0.985 * counted.fitted);
      CHECK(parameter.profile >= 0.90 * counted.fitted);
      CHECK(parameter.profile <= 0.985 * counted.fitted);
      CHECK(parameter.offset_scatter == Approx(1).margin(0.2));
    }
  }
}

TEST_CASE("a design foretells the errors of the fit with the measurement added", "[fitting][design]") {
  const auto scenes = thirty_values();
  auto inputs = zener_inputs();
  const auto fitted = [&](const std::vector<MeasuredScene>& data) {
    FitProblem problem = resistance_problem(data, inputs, quick_resistance);
    problem.deviations_known = true;
    return fit(problem, {.profiles = false});
  };
  const FitReport report = fitted(scenes);
  std::vector<MeasuredScene> candidates;
  for (const double load : {3e3, 1e4, 4e4, 1e5})
    for (const double speed : {0.001, 0.03, 1.0, 20.0}) candidates.push_back({half_space_scene(speed, load), {}});
  const MeasurementPlan next = design(report, inputs, candidates, quick_resistance);
  REQUIRE(next.choices.size() == candidates.size());
  const DesignChoice& best = next.choices.front();
  CHECK(next.ratio(best) <= next.ratio(next.choices.back()));
  for (const DesignChoice* choice : {&best, &next.choices.back()}) {
    auto more = scenes;
    more.push_back({choice->scene, {choice->predicted, choice->deviation, "new"}});
    const FitReport after = fitted(more);
    for (std::size_t j = 0; j < 3; ++j)
      CHECK(after.parameters[j].relative_error ==
            Approx(choice->deviations[static_cast<Eigen::Index>(j)]).epsilon(0.02));
  }
}

TEST_CASE("measurements that are named together leave no parameter worse known than any other pair does",
          "[fitting][design]") {
  FitProblem problem = resistance_problem(thirty_values(), zener_inputs(), quick_resistance);
  problem.deviations_known = true;
  const FitReport report = fit(problem, {.profiles = false});
  std::vector<MeasuredScene> candidates;
  for (const double load : {3e3, 1e4, 4e4})
    for (const double speed : {0.001, 0.03, 1.0, 20.0}) candidates.push_back({half_space_scene(speed, load), {}});
  const MeasurementPlan plan = design(report, zener_inputs(), candidates, quick_resistance);
  const JointChoice pair = best_together(plan, 2);
  REQUIRE(pair.choices.size() == 2);
  // Every pair, from the information J^T J / s^2 that it adds.
  double least = std::numeric_limits<double>::infinity();
  for (const DesignChoice& a : plan.choices)
    for (const DesignChoice& b : plan.choices) {
      Eigen::MatrixXd information = plan.covariance.inverse();
      for (const DesignChoice* one : {&a, &b})
        information += one->slope * one->slope.transpose() / (one->deviation * one->deviation);
      least = std::min(least, information.inverse().diagonal().maxCoeff());
    }
  CHECK(pair.deviations.maxCoeff() == Approx(std::sqrt(least)).epsilon(1e-6));
  CHECK(pair.deviations.maxCoeff() < plan.choices.front().deviations.maxCoeff());
}
