#include "studies/optimise/pareto.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rollres {

namespace {

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

std::vector<double> limits_between(double from, double to, std::size_t count) {
  std::vector<double> limits;
  for (std::size_t i = 1; i <= count; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(count + 1);
    limits.push_back(from > 0 && to > 0 ? from * std::pow(to / from, part) : from + part * (to - from));
  }
  return limits;
}

/// The problem of the second goal alone, whose designs tell the first as their second value.
DesignProblem turned(DesignProblem problem) {
  std::swap(problem.goal, problem.pareto->goal);
  return problem;
}

}  // namespace

bool ParetoReport::complete() const {
  return !interrupted && std::all_of(points.begin(), points.end(), [](const ParetoPoint& point) {
    return point.report.status == DesignStatus::optimum;
  });
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
  const std::optional<Design> end = last.report.best;

  DesignProblem bounded = problem;
  if (end && end->second != first->second)
    for (const double limit :
         limits_between(first->second, end->second, static_cast<std::size_t>(problem.pareto->points - 2))) {
      if (front.interrupted) break;
      bounded.bound = {problem.pareto->goal, limit};
      if (const auto best = solve(bounded, limit).report.best) bounded.start = best->point;
    }
  front.points.push_back(std::move(last));
  front.count = evaluations.count();
  for (ParetoPoint& point : front.points)
    point.dominated =
        point.report.best && std::any_of(front.points.begin(), front.points.end(), [&](const auto& other) {
          return other.report.best && dominates(problem, *other.report.best, *point.report.best);
        });
  return front;
}

}  // namespace rollres
