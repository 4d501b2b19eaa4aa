#include "studies/optimise/optimise.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <utility>

#include "studies/study/sampling.hpp"

namespace rollres {

namespace {

constexpr double first_step = 0.1, polishing_step = 0.03;
constexpr double share_of_first = 0.8, share_of_global = 2.0 / 3;  // of the evaluations; the rest is for what follows

bool global_search(const DesignProblem& problem, Algorithm algorithm) {
  return problem.global || traits(algorithm).global;
}

Algorithm local_algorithm(const DesignProblem& problem) {
  const bool constrained = !problem.constraints.empty() || problem.bound;
  const bool enough = problem.variables.size() >= traits(Algorithm::bobyqa).fewest_variables;
  return constrained || !enough ? Algorithm::cobyla : Algorithm::bobyqa;
}

/// Sum of what a design exceeds its constraints by, relative.
double excess(const DesignScale& scale, const Design& design) {
  const std::vector<double> all = scale.constraints(design);
  return std::accumulate(all.begin(), all.end(), 0.0, [](double sum, double one) { return sum + std::max(0.0, one); });
}

class Optimisation {
 public:
  Optimisation(const DesignProblem& problem, StoredEvaluations& evaluations, const OptimiseOptions& options)
      : problem_(problem), evaluator_(problem, evaluations, options.jobs, [this, &options] {
          if (!options.report) return;
          const auto best = evaluator_.best();
          const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin_;
          options.report({evaluator_.count() - before_, best ? std::optional(best->value) : std::nullopt,
                          evaluation_limit(problem_), taken.count()});
        }) {}

  OptimiseReport run() {
    try {
      go();
    } catch (const Interrupted&) {
      report_.status = DesignStatus::interrupted;
      report_.reason = "the same command goes on where it stopped";
      report_.optimum.reset();
    }
    report_.best = evaluator_.best();
    report_.designs = evaluator_.designs();
    report_.count = evaluator_.count() - before_;
    if (!report_.best && scale_) report_.nearest = nearest();
    return std::move(report_);
  }

 private:
  std::size_t left() const {
    const std::size_t all = evaluation_limit(problem_);
    return all - std::min(all, evaluator_.count().all() - before_.all() - report_.slope_evaluations);
  }

  /// The start if it has a value, else the first of some points that fill the box evenly which is feasible, or at
  /// least has a value.
  std::optional<Design> first_found() {
    const Design start = evaluator_(problem_.start);
    if (start.found()) return start;
    const std::size_t size = problem_.variables.size(), tries = 16 * size;
    const auto sample = unit_sample(SampleMethod::sobol, tries + 1, size);
    std::optional<Design> first;
    std::vector<double> place(size);
    for (std::size_t k = 1; k <= tries && left() > 0; ++k) {  // the first is the origin
      for (std::size_t i = 0; i < size; ++i) place[i] = sample[i][k];
      const Design design = evaluator_(point_in_box(problem_, place));
      if (design.feasible()) return design;
      if (design.found() && !first) first = design;
    }
    if (!first) report_.reason = "no design has an answer; at the start: " + start.reason;
    return first;
  }

  /// That with the smallest excess over its constraints.
  std::optional<Design> nearest() const {
    std::optional<Design> nearest;
    for (const Design& design : evaluator_.designs())
      if (!nearest || excess(*scale_, design) < excess(*scale_, *nearest)) nearest = design;
    return nearest;
  }

  void run_search(Algorithm algorithm, const Design& start, double step, double share = 1) {
    const std::size_t before = evaluator_.count().all();
    const auto allowed = static_cast<std::size_t>(std::ceil(share * static_cast<double>(left())));
    std::optional<DesignSlopes> slopes;
    if (traits(algorithm).slopes) slopes.emplace(evaluator_, *scale_, start);
    const SearchOptions options{algorithm, step, problem_.stop.tolerance, before + allowed};
    const SearchEnd end = search(evaluator_, *scale_, start, options, slopes ? &*slopes : nullptr);
    report_.searches.push_back({algorithm, end, evaluator_.count().all() - before});
  }

  /// Slopes at the best design.
  void examine() {
    const Design best = *evaluator_.best();
    const std::size_t before = evaluator_.count().all();
    const DesignSlopes slopes(evaluator_, *scale_, best);
    report_.optimum = examine_optimum(problem_, *scale_, slopes, best, problem_.stop.tolerance);
    report_.slope_evaluations += evaluator_.count().all() - before;
  }

  void go() {
    const std::optional<Design> start = first_found();
    if (!start) return;
    scale_.emplace(problem_, *start);
    if (problem_.variables.empty()) {  // everything is chosen from lists
      if (evaluator_.best()) report_.status = DesignStatus::optimum;
      return;
    }
    const Algorithm algorithm = problem_.algorithm.value_or(default_algorithm(problem_));
    if (global_search(problem_, algorithm)) {
      const bool global = traits(algorithm).global;
      run_search(global ? algorithm : Algorithm::direct_l, *start, first_step, share_of_global);
      const Design from = evaluator_.best().value_or(*start);
      run_search(global ? local_algorithm(problem_) : algorithm, from, polishing_step);
    } else {
      run_search(algorithm, *start, first_step, share_of_first);
    }
    if (!evaluator_.best() && left() > 0) run_search(Algorithm::cobyla, *nearest(), polishing_step);
    if (!evaluator_.best()) {
      report_.reason = left() == 0 ? "the evaluations are spent" : "the search ended without one";
      return;
    }
    polish();
  }

  void polish() {
    examine();
    for (const Algorithm algorithm : {Algorithm::slsqp, Algorithm::cobyla}) {
      const std::vector<double> before = evaluator_.best()->point;
      if (report_.optimum->confirmed() || left() == 0) break;
      run_search(algorithm, *evaluator_.best(), polishing_step);
      if (evaluator_.best()->point != before) examine();
    }
    report_.reason = report_.optimum->reason;
    if (report_.optimum->confirmed())
      report_.status = DesignStatus::optimum;
    else
      report_.status = left() == 0 ? DesignStatus::evaluation_limit : DesignStatus::unconfirmed;
  }

  const DesignProblem& problem_;
  DesignEvaluator evaluator_;
  EvaluationCount before_ = evaluator_.count();  // of other problems
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::optional<DesignScale> scale_;
  OptimiseReport report_;
};

/// As `problem`, from another start.
DesignProblem from(DesignProblem problem, const std::vector<double>& start) {
  problem.start = start;
  return problem;
}

/// Whether `a` makes `b` needless.
bool dominates(const DesignProblem& problem, const Design& a, const Design& b) {
  const Goal &first = problem.goal, &second = problem.pareto->goal;
  if (first.better(b.value, a.value) || second.better(b.second, a.second)) return false;
  return first.better(a.value, b.value) || second.better(a.second, b.second);
}

void mark_dominated(const DesignProblem& problem, ParetoReport& front) {
  for (ParetoPoint& point : front.points)
    point.dominated = point.report.best && any_of(front.points, [&](const auto& other) {
                        return other.report.best && dominates(problem, *other.report.best, *point.report.best);
                      });
}

std::vector<double> limits_between(double from, double to, std::size_t count) {
  std::vector<double> limits;
  for (std::size_t i = 1; i <= count; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(count + 1);
    limits.push_back(from > 0 && to > 0 ? from * std::pow(to / from, part) : from + part * (to - from));
  }
  return limits;
}

/// Whether two values differ by more than the searches miss the best ones by.
bool differ(double a, double b) {
  constexpr double relative = 1e-3;
  return std::abs(a - b) > relative * std::max(std::abs(a), std::abs(b));
}

/// The problem of the second goal alone, whose designs tell the first as their second value.
DesignProblem turned(DesignProblem problem) {
  std::swap(problem.goal, problem.pareto->goal);
  return problem;
}

}  // namespace

Algorithm default_algorithm(const DesignProblem& problem) {
  return problem.global ? Algorithm::direct_l : local_algorithm(problem);
}

std::size_t evaluation_limit(const DesignProblem& problem) {
  if (problem.stop.evaluations > 0) return static_cast<std::size_t>(problem.stop.evaluations);
  const Algorithm algorithm = problem.algorithm.value_or(default_algorithm(problem));
  const std::size_t for_each = global_search(problem, algorithm) ? 300 : 100;
  return for_each * (problem.variables.size() + 1) * problem.scenes_of_a_design();
}

OptimiseReport optimise(const DesignProblem& problem, StoredEvaluations& evaluations, const OptimiseOptions& options) {
  OptimiseReport report = Optimisation(problem, evaluations, options).run();
  evaluations.flush();
  return report;
}

bool ParetoReport::any() const {
  return any_of(points, [](const ParetoPoint& point) { return bool{point.report.best}; });
}

bool ParetoReport::complete() const {
  return !interrupted &&
         all_of(points, [](const ParetoPoint& point) { return point.report.status == DesignStatus::optimum; });
}

ParetoReport pareto_front(const DesignProblem& problem, StoredEvaluations& evaluations,
                          const OptimiseOptions& options) {
  ParetoReport front;
  const auto solve = [&](const DesignProblem& one, double limit) -> const ParetoPoint& {
    front.points.push_back({optimise(one, evaluations, options), limit});
    front.count = evaluations.count();
    front.interrupted = front.points.back().report.status == DesignStatus::interrupted;
    return front.points.back();
  };
  const double none = RollingSolution::absent;
  const std::optional<Design> first = solve(problem, none).report.best;
  if (front.interrupted || !first) return front;
  ParetoPoint last{optimise(turned(from(problem, first->point)), evaluations, options), none};
  front.interrupted = last.report.status == DesignStatus::interrupted;
  for (std::optional<Design>* const design : {&last.report.best, &last.report.nearest})
    if (*design) std::swap((*design)->value, (*design)->second);
  for (Design& design : last.report.designs) std::swap(design.value, design.second);
  const std::optional<Design> end = last.report.best;

  DesignProblem bounded = problem;
  front.conflict = !end || differ(first->second, end->second) || differ(first->value, end->value);
  if (end && front.conflict)
    for (const double limit :
         limits_between(first->second, end->second, static_cast<std::size_t>(problem.pareto->points - 2))) {
      if (front.interrupted) break;
      bounded.bound = {problem.pareto->goal, limit};
      if (const auto best = solve(bounded, limit).report.best) bounded.start = best->point;
    }
  front.points.push_back(std::move(last));
  front.count = evaluations.count();
  mark_dominated(problem, front);
  return front;
}

ParetoReport pareto_front(std::span<const DesignProblem> problems, StoredEvaluations& evaluations,
                          const OptimiseOptions& options) {
  if (problems.size() == 1) return pareto_front(problems.front(), evaluations, options);
  ParetoReport all;
  for (std::size_t choice = 0; choice < problems.size() && !all.interrupted; ++choice) {
    evaluations.be_of_variant(problems[choice].variant());
    ParetoReport one = pareto_front(problems[choice], evaluations, options);
    for (ParetoPoint& point : one.points) {
      point.choice = choice;
      all.points.push_back(std::move(point));
    }
    all.interrupted = one.interrupted;
  }
  all.count = evaluations.count();
  const DesignProblem& problem = problems.front();
  mark_dominated(problem, all);
  stable_sort(all.points, [&](const ParetoPoint& a, const ParetoPoint& b) {
    if (!a.report.best || !b.report.best) return a.report.best && !b.report.best;
    return problem.goal.better(a.report.value(), b.report.value());
  });
  const auto same = [](const ParetoPoint& a, const ParetoPoint& b) {
    return a.report.best && b.report.best && a.report.best->keys == b.report.best->keys;
  };
  all.points.erase(std::unique(all.points.begin(), all.points.end(), same), all.points.end());
  const Design* first = nullptr;  // of the front
  all.conflict = false;
  for (const ParetoPoint& point : all.points) {
    if (!point.report.best || point.dominated) continue;
    const Design& design = *point.report.best;
    if (!first) first = &design;
    all.conflict = all.conflict || differ(first->value, design.value) || differ(first->second, design.second);
  }
  return all;
}

}  // namespace rollres
