#include "studies/optimise/design_evaluator.hpp"

#include <algorithm>
#include <utility>

namespace rollres {

DesignEvaluator::DesignEvaluator(const DesignProblem& problem, StoredEvaluations& evaluations, int jobs,
                                 std::function<void()> report)
    : problem_(problem), evaluations_(evaluations), jobs_(jobs), report_(std::move(report)) {}

Design DesignEvaluator::operator()(std::span<const double> point, int jobs) {
  const Design design = evaluate_design(
      problem_, point, [this](const RollingScene& scene) { return evaluations_(scene); }, jobs);
  {
    const std::lock_guard lock(mutex_);
    if (design.found() && seen_.insert(design.point).second) designs_.push_back(design);
    const Goal& goal = problem_.goal;
    if (design.feasible() && (!best_ || goal.better(design.value, best_->value) ||
                              (design.value == best_->value && design.point < best_->point)))
      best_ = design;
  }
  if (report_) {
    const std::lock_guard lock(reporting_);
    report_();
  }
  return design;
}

std::optional<Design> DesignEvaluator::best() const {
  const std::lock_guard lock(mutex_);
  return best_;
}

std::vector<Design> DesignEvaluator::designs() const {
  const std::lock_guard lock(mutex_);
  return designs_;
}

}  // namespace rollres
