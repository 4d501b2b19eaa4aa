#include "studies/optimise/optimise.hpp"

#include <atomic>
#include <limits>
#include <stdexcept>

#include "db/queries/query.hpp"
#include "tests/catch.hpp"
#include "tests/studies/design_bowl.hpp"
#include "tests/studies/temporary_directory.hpp"

// Covers design_search, design_evaluator and design_optimum, too.

using namespace rollres;

namespace {

std::vector<Algorithm> all_algorithms() {
  std::vector<Algorithm> all;
  for (std::size_t i = 0; i < ChoiceNames<Algorithm>::names.size(); ++i) all.push_back(static_cast<Algorithm>(i));
  return all;
}

OptimiseReport run(const DesignProblem& problem, const Evaluate& evaluate = Bowl::solve) {
  StoredEvaluations evaluations(evaluate);
  return optimise(problem, evaluations, {.jobs = 1});
}

// Least ln R on x + y >= 1.2: from (2 dx + 0.4 dy, dy + 0.4 dx) = lambda (1, 1) and dx + dy = 0.3.
constexpr double constrained_x = 0.3 + 0.3 * 0.6 / 2.2, constrained_y = 0.6 + 0.3 * 1.6 / 2.2;
constexpr double multiplier = (2 * 0.6 + 0.4 * 1.6) * 0.3 / 2.2;

/// The best of the stored rows that meet the constraint p >= least.
double best_stored(const Database& database, double least) {
  const Table rows = run_query(database, {.filters = {{"status", Comparison::equal, "converged"}},
                                          .columns = {"rolling_resistance", "peak_pressure"}});
  double best = std::numeric_limits<double>::infinity();
  for (const auto& row : rows.rows) {
    const auto* const value = std::get_if<double>(&row[0]);
    const auto* const pressure = std::get_if<double>(&row[1]);
    if (value && pressure && *pressure >= least) best = std::min(best, *value);
  }
  return best;
}

}  // namespace

TEST_CASE("every algorithm finds the optimum of a closed form inside its box", "[studies][optimise]") {
  for (const Algorithm algorithm : all_algorithms()) {
    CAPTURE(name_of(algorithm));
    DesignProblem problem = bowl_problem();
    problem.algorithm = algorithm;
    const OptimiseReport report = run(problem);
    CHECK(report.status == DesignStatus::optimum);
    REQUIRE(report.best);
    CHECK(report.value() == Approx(1).epsilon(1e-4));
    CHECK(report.searches.front().algorithm == algorithm);
    CHECK(report.count.all() <= evaluation_limit(problem) + report.slope_evaluations + 40);
  }
}

TEST_CASE("every algorithm finds the optimum of a closed form on a constraint, and its multiplier",
          "[studies][optimise]") {
  const double least = std::exp(Bowl::log_resistance(constrained_x, constrained_y));
  for (const Algorithm algorithm : all_algorithms()) {
    CAPTURE(name_of(algorithm));
    DesignProblem problem = bowl_problem({"peak_pressure >= 1 Pa"});
    problem.algorithm = algorithm;
    const OptimiseReport report = run(problem);
    CHECK(report.status == DesignStatus::optimum);
    REQUIRE(report.best);
    CHECK(report.best->feasible());
    CHECK(report.value() == Approx(least).epsilon(1e-3));  // what `promise` allows, twice
    CHECK(report.optimum->constraints[0].active);
    CHECK(report.optimum->constraints[0].multiplier == Approx(multiplier).epsilon(0.05));
  }
}

TEST_CASE("an optimum on a bound names the bound, and its elasticities are those of the closed form",
          "[studies][optimise]") {
  DesignProblem problem = bowl_problem();
  problem.goal = {Formula("rolling_resistance * layer_thickness^2", FormulaNames::inputs_and_outputs)};
  const OptimiseReport report = run(problem);
  CHECK(report.status == DesignStatus::optimum);
  REQUIRE(report.best);
  CHECK(report.best->point[0] == Approx(1e-3).epsilon(1e-12));
  CHECK(report.optimum->bounds[0] == ActiveBound::lowest);
  CHECK(report.optimum->bounds[1] == ActiveBound::none);
  const double y = 0.6 + 0.4 * 0.3;  // d ln R / dy = 0 at x = 0
  CHECK(Bowl::y(scenes_at(problem, report.best->point)[0]) == Approx(y).margin(0.01));
  const double slope = (2 * -0.3 + 0.4 * (y - 0.6)) / std::log(20.0) + 2;
  CHECK(report.optimum->goal.of[0] == Approx(slope).epsilon(1e-2));
}

TEST_CASE("maximising is minimising the opposite", "[studies][optimise]") {
  DesignProblem problem = bowl_problem({"peak_pressure >= 1 Pa"});
  problem.goal = {Formula("-rolling_resistance", FormulaNames::inputs_and_outputs), true};
  const OptimiseReport report = run(problem);
  CHECK(report.status == DesignStatus::optimum);
  CHECK(-report.value() == Approx(std::exp(Bowl::log_resistance(constrained_x, constrained_y))).epsilon(1e-3));
}

TEST_CASE(
    "where a third of the box has no answer every algorithm returns the best stored row, and never claims an "
    "optimum that is none",
    "[studies][optimise][long]") {
  const double least = std::exp(Bowl::log_resistance(constrained_x, constrained_y));
  int found = 0;
  enum class Failure { not_a_number, exception, not_converged };
  for (const double edge : {2.0 / 3, 1.0 / 3})  // the optimum has an answer, or lies where there is none
    for (const Failure failure : {Failure::not_a_number, Failure::exception, Failure::not_converged}) {
      const Evaluate evaluate = [=](const RollingScene& scene) {
        RollingSolution solution = Bowl::solve(scene);
        const double x = Bowl::x(scene);
        if (edge > 0.5 ? x < edge : x < edge || x > 2 * edge) return solution;
        if (failure == Failure::exception) throw std::runtime_error("no answer here");
        if (failure == Failure::not_converged) solution.status = Status::not_converged;
        solution.rolling_resistance = std::nan("");
        return solution;
      };
      for (const Algorithm algorithm : all_algorithms()) {
        CAPTURE(name_of(algorithm), edge, static_cast<int>(failure));
        DesignProblem problem = bowl_problem({"peak_pressure >= 1 Pa"});
        problem.algorithm = algorithm;
        if (traits(algorithm).global) problem.stop.evaluations = 300;
        const TemporaryDirectory folder;
        ResultStore store(folder / "results.db");
        StoredEvaluations evaluations(evaluate, folder / "results.db",
                                      {"bowl", {"layer_thickness", "static_shear_modulus"}, "{}"});
        const OptimiseReport report = optimise(problem, evaluations, {.jobs = 1});
        if (!report.best) {
          CHECK(report.status == DesignStatus::no_feasible_design);
          CHECK(std::isinf(best_stored(store.database(), 1)));
          continue;
        }
        ++found;
        CHECK(report.best->feasible());
        CHECK(std::isfinite(report.value()));
        CHECK(report.value() == best_stored(store.database(), 1));
        CHECK(store.contains(report.best->keys.front()));
        if (report.status == DesignStatus::optimum) CHECK(report.value() == Approx(least).epsilon(1e-3));
        if (edge < 0.5) CHECK(report.status != DesignStatus::optimum);
      }
    }
  CHECK(found == 60);
}

TEST_CASE("an interrupted search goes on from the store to the same design and solves nothing twice",
          "[studies][optimise]") {
  const DesignProblem problem = bowl_problem({"peak_pressure >= 1 Pa"});
  const OptimiseReport undisturbed = run(problem);
  const TemporaryDirectory folder;
  const StudyRecord study{"bowl", {"layer_thickness", "static_shear_modulus"}, "{}"};
  std::size_t solved = 0;
  OptimiseReport last;
  for (int start = 0; start == 0 || last.status == DesignStatus::interrupted; ++start) {
    std::atomic<bool> stop = false;
    int here = 0;
    StoredEvaluations evaluations(
        [&](const RollingScene& scene) {
          stop = ++here == 9;
          return Bowl::solve(scene);
        },
        folder / "results.db", study, &stop);
    last = optimise(problem, evaluations, {.jobs = 1});
    solved += last.count.solved;
    if (last.status == DesignStatus::interrupted) CHECK(last.count.solved == 9);
  }
  CHECK(last.status == undisturbed.status);
  CHECK(last.best->point == undisturbed.best->point);
  CHECK(solved == undisturbed.count.solved);
  CHECK(last.count.all() == undisturbed.count.all());

  ResultStore store(folder / "results.db");
  CHECK(store.points("bowl").size() == solved);
  CHECK(store.study("bowl")->answered == static_cast<std::int64_t>(solved));
  StoredEvaluations again(Bowl::solve, folder / "results.db", study);
  CHECK(optimise(problem, again, {.jobs = 1}).best->point == undisturbed.best->point);
  CHECK(again.count().solved == 0);
  StoredEvaluations other(Bowl::solve, folder / "results.db", {"bowl", {}, "{ }"});
  CHECK(store.points("bowl").empty());  // another definition begins anew
}

TEST_CASE("without a feasible design the nearest one is named, and nothing is claimed", "[studies][optimise]") {
  const OptimiseReport report = run(bowl_problem({"peak_pressure <= 0.5 Pa", "peak_pressure >= 1 Pa"}));
  CHECK(report.status == DesignStatus::no_feasible_design);
  CHECK_FALSE(report.best);
  REQUIRE(report.nearest);
  CHECK(std::isfinite(report.nearest->value));

  const OptimiseReport nothing = run(
      bowl_problem(), [](const RollingScene&) -> RollingSolution { throw std::runtime_error("no answer anywhere"); });
  CHECK(nothing.status == DesignStatus::no_feasible_design);
  CHECK_THAT(nothing.reason, Catch::Contains("no answer anywhere"));
  CHECK(nothing.count.failed == nothing.count.all());
}

TEST_CASE("a start without an answer is replaced by one that has an answer", "[studies][optimise]") {
  DesignProblem problem = bowl_problem();
  const OptimiseReport report = run(problem, [](const RollingScene& scene) {
    if (Bowl::x(scene) > 0.5 && Bowl::y(scene) < 0.35) throw std::runtime_error("no");
    return Bowl::solve(scene);
  });
  CHECK(report.value() == Approx(1).epsilon(1e-3));
}

TEST_CASE("a search ends at its limit of evaluations and says so", "[studies][optimise]") {
  DesignProblem problem = bowl_problem({"peak_pressure >= 1 Pa"});
  problem.stop.evaluations = 5;
  const OptimiseReport report = run(problem);
  CHECK(report.status == DesignStatus::evaluation_limit);
  CHECK(report.count.all() - report.slope_evaluations == 5);
  CHECK(report.best.has_value());
}

TEST_CASE("a duty cycle is weighed scene by scene, and its constraints hold in each", "[studies][optimise]") {
  DesignProblem problem = bowl_problem({"peak_pressure >= load / 1e4"});
  problem.scenes.push_back({problem.scenes.front().scene, 3});
  problem.scenes.back().scene.load = 2e4;  // the second scene needs ln p >= ln 2
  problem.goal = {Formula("rolling_resistance * load", FormulaNames::inputs_and_outputs)};
  const OptimiseReport report = run(problem);
  CHECK(report.status == DesignStatus::optimum);
  REQUIRE(report.best);
  CHECK(report.best->constraints.size() == 2);
  CHECK_FALSE(report.optimum->constraints[0].active);
  CHECK(report.optimum->constraints[1].active);
  const RollingScene scene = scenes_at(problem, report.best->point)[1];
  CHECK(Bowl::x(scene) + Bowl::y(scene) == Approx(1.2 + std::log(2.0)).margin(1e-3));
  CHECK(report.value() == Approx(Bowl::solve(scene).rolling_resistance * (1e4 + 3 * 2e4)));
  const double one = Bowl::solve(scene).rolling_resistance;
  const auto value_over = [&](OverScenes over) {
    problem.goal.over = over;
    return evaluate_design(problem, report.best->point, Bowl::solve).value;
  };
  CHECK(value_over(OverScenes::mean) == Approx(one * (1e4 + 3 * 2e4) / 4));
  CHECK(value_over(OverScenes::max) == Approx(one * 2e4));  // what it is in that scene, whatever its weight
  CHECK(value_over(OverScenes::min) == Approx(one * 1e4));
}

TEST_CASE("a front between two goals is that of the closed form, none of its designs needless", "[studies][optimise]") {
  // On the front grad ln R = -lambda grad ln p: x + y = s is best at dx = 0.6 s' / 2.2, dy = 1.6 s' / 2.2.
  DesignProblem problem = bowl_problem();
  problem.pareto = {{Formula("peak_pressure", FormulaNames::inputs_and_outputs), true}, 5};
  StoredEvaluations evaluations(Bowl::solve);
  const ParetoReport front = pareto_front(problem, evaluations, {.jobs = 1});
  REQUIRE(front.points.size() == 5);
  CHECK(front.complete());
  for (std::size_t i = 0; i < front.points.size(); ++i) {
    CAPTURE(i);
    const Design& design = *front.points[i].report.best;
    CHECK_FALSE(front.points[i].dominated);
    if (i > 0) CHECK(design.second > front.points[i - 1].report.best->second);
    if (i > 0) CHECK(design.value > front.points[i - 1].report.best->value);
    const double rest = std::log(design.second) + 1.2 - 0.9;
    const double dx = 0.6 * rest / 2.2, dy = 1.6 * rest / 2.2;
    if (dx < 0.7 && dy < 0.4)
      CHECK(design.value == Approx(std::exp(Bowl::log_resistance(0.3 + dx, 0.6 + dy))).epsilon(1e-3));
  }
}
