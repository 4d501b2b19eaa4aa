#include <cmath>

#include "fitting/fit/coverage.hpp"
#include "fitting/fit/fit.hpp"
#include "fitting/fit/resistance_fit.hpp"
#include "tests/catch.hpp"
#include "tests/fitting/measured_hunter.hpp"
#include "tests/plain_scene.hpp"
#include "tests/source_directory.hpp"

// Covers secant_slopes, too.

using namespace rollres;

namespace {

/// The paper's cylinder or sphere; its numbers are the truth that fits shall find.
RollingScene paper_scene(Indenter indenter, double speed, double load) {
  RollingScene scene;
  scene.indenter = indenter;
  scene.radius = 0.02;
  scene.layer_thickness = 0.005;
  scene.layer_density = 1000;
  scene.static_shear_modulus = 3e6;
  scene.stiffening = 1;
  scene.creep_time = 0.25;
  scene.friction_coefficient = 0.2;
  scene.speed = speed;
  scene.load = load;
  return scene;
}

/// Values by scenes that `with_grid` changes, each with its own error estimate as its deviation.
std::vector<MeasuredScene> by_grid(const std::vector<RollingScene>& scenes, void (*with_grid)(RollingScene&)) {
  std::vector<MeasuredScene> rows;
  for (const RollingScene& scene : scenes) {
    RollingScene gridded = scene;
    with_grid(gridded);
    const RollingSolution answer = solve(gridded);
    REQUIRE(answer.status == Status::converged);
    rows.push_back({scene, {answer.rolling_resistance, answer.error_estimate * answer.rolling_resistance, "row"}});
  }
  return rows;
}

/// By how much errors of the data, each as large as its deviation and of whatever sign, can move each parameter.
Eigen::VectorXd largest_move(const FitReport& report) {
  Eigen::VectorXd moves = Eigen::VectorXd::Zero(std::ssize(report.parameters));
  for (std::size_t i = 0; i < report.values.size(); ++i) {
    const Eigen::VectorXd row =
        report.slopes.derivatives.row(static_cast<Eigen::Index>(i)).transpose() / report.values[i].measured.deviation;
    moves += (report.errors.covariance * row).cwiseAbs();
  }
  return moves;
}

}  // namespace

TEST_CASE("data of a fine grid give a cylinder's material back within that grid's stated error",
          "[fitting][resistance_fit][solver][long]") {
  std::vector<RollingScene> scenes;
  for (const double load : {1e4, 2e4})
    for (const double speed : spread_speeds(0.008, 2, 6))
      scenes.push_back(paper_scene(Indenter::cylinder, speed, load));
  const auto rows = by_grid(scenes, [](RollingScene& scene) {
    scene.method = Method::newton;
    scene.spacing = 2e-5;
  });
  const FitProblem problem = [&] {
    FitProblem known = resistance_problem(
        rows, {{{"static_shear_modulus"}, 2e6}, {{"stiffening"}, 2.0}, {{"creep_time"}, 0.1}}, solve);
    known.deviations_known = true;
    return known;
  }();
  const FitReport report = fit(problem, {.profiles = false});
  INFO(name_of(report.status) << ": " << report.reason);
  CHECK(report.status >= FitStatus::usable_with_warnings);
  CHECK(report.noise < 1e-7);
  const Eigen::VectorXd moves = largest_move(report);
  const double truth[] = {3e6, 1, 0.25};
  for (std::size_t j = 0; j < 3; ++j) {
    CAPTURE(j);
    CHECK(std::abs(std::log(report.parameters[j].value / truth[j])) < moves[static_cast<Eigen::Index>(j)]);
    CHECK(moves[static_cast<Eigen::Index>(j)] < 0.3);
  }
}

TEST_CASE("data of a finer grid give a sphere's material back within the stated errors of both grids",
          "[fitting][resistance_fit][solver][long]") {
  std::vector<RollingScene> scenes;
  for (const double load : {100.0, 200.0})
    for (const double speed : spread_speeds(0.01, 0.3, 3)) {
      scenes.push_back(paper_scene(Indenter::sphere, speed, load));
      scenes.back().friction_coefficient = 0;
      scenes.back().tolerance = 0.02;  // some 60 nodes
    }
  auto rows = by_grid(scenes, [](RollingScene& scene) {
    scene.tolerance.reset();
    scene.spacing = 2.5e-4;
  });
  for (MeasuredScene& row : rows) {
    const RollingSolution coarse = solve(row.scene);
    row.measured.deviation += coarse.error_estimate * coarse.rolling_resistance;
  }
  FitProblem problem = resistance_problem(rows, {{{"stiffening"}, 2.0}, {{"creep_time"}, 0.1}}, solve);
  problem.deviations_known = true;
  const FitReport report = fit(problem, {.profiles = false});
  INFO(name_of(report.status) << ": " << report.reason);
  CHECK(report.status >= FitStatus::usable_with_warnings);
  const Eigen::VectorXd moves = largest_move(report);
  const double truth[] = {1, 0.25};
  for (std::size_t j = 0; j < 2; ++j) {
    CAPTURE(j);
    const double slope = std::abs(report.parameters[j].parameter.variable.slope(truth[j]));
    CHECK(std::abs(report.parameters[j].value - truth[j]) < slope * moves[static_cast<Eigen::Index>(j)]);
    CHECK(moves[static_cast<Eigen::Index>(j)] < 0.3);
  }
}

TEST_CASE("95 % intervals by the solver hold the truth as often as they say", "[fitting][coverage][solver][long]") {
  std::vector<RollingScene> scenes;
  for (const double load : {1e4, 4e4})
    for (const double speed : spread_speeds(0.005, 5, 6)) scenes.push_back(half_space_scene(speed, load));
  std::vector<MeasuredScene> rows;
  for (const RollingScene& scene : scenes) {
    const double value = solve(scene).rolling_resistance;
    rows.push_back({scene, {value, 0.02 * value, "row"}});
  }
  FitProblem problem = resistance_problem(rows, zener_inputs(), solve, {.jobs = 1});
  problem.deviations_known = true;
  const Coverage counted = coverage(problem, {1e6, 2, 0.1}, 1, {.draws = thinned(40), .seed = 3, .profiles = true});
  CHECK(counted.fitted == thinned(40));
  if (thinned(40) < 40) return;  // too few to count
  // Of 40 intervals that hold with 95 %, 32 or fewer do with a probability of 7e-4 (binomial).
  for (const ParameterCoverage& parameter : counted.parameters) {
    CHECK(parameter.linear > 32);
    CHECK(parameter.profile > 32);
  }
}
