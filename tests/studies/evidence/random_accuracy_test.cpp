#include "studies/evidence/random_accuracy.hpp"

#include <cmath>

#include "tests/catch.hpp"

using namespace rollres;

namespace {

/// R_r = 1 N off by a hundredth on a grid, by half the tolerance with one; the estimate is twice the tolerance, or the
/// fiftieth on a grid: too small for the spheres.
RollingSolution plain(const RollingScene& scene) {
  RollingSolution solution;
  solution.status = Status::converged;
  solution.method = scene.method;
  solution.rolling_resistance = 1 + (scene.tolerance ? 0.5 * *scene.tolerance : 0.01);
  solution.error_estimate =
      scene.tolerance ? 2 * *scene.tolerance : (scene.indenter == Indenter::sphere ? 0.001 : 0.02);
  if (scene.tolerance && *scene.tolerance < 1e-3) {
    solution.rolling_resistance = 1;
    solution.error_estimate = 1e-9;
  }
  solution.contact_nodes = 7;
  return solution;
}

}  // namespace

TEST_CASE("on random scenes estimates are counted as covering or not, and tolerances as met", "[studies][random]") {
  RandomAccuracyPlan plan;
  plan.cylinders = 5;
  plan.spheres = 3;
  plan.jobs = 1;
  const RandomAccuracyReport report = measure_random_accuracy(plan, plain);
  CHECK_FALSE(report.interrupted);
  const std::vector<RandomAccuracyCount> counts = counts_of(report.solutions);
  REQUIRE(counts.size() == 6 + 4);  // spectral, newton and active_set; tolerances
  for (const RandomAccuracyCount& count : counts) {
    CAPTURE(name_of(count.method), name_of(count.indenter), count.tolerance);
    const bool sphere = count.indenter == Indenter::sphere, on_a_grid = std::isnan(count.tolerance);
    CHECK(count.converged == (sphere ? 3 : 5));
    CHECK(count.judged == count.converged);
    CHECK(count.covered == (sphere && on_a_grid ? 0 : 1));
    CHECK(count.median_nodes == 7);
    if (on_a_grid)
      CHECK(count.median_ratio == Approx(sphere ? 0.1 : 2));
    else
      CHECK(count.met == 1);
  }
  CHECK(judged_table(report.solutions).rows.size() == 5 * 6 + 3 * 4);
}
