#include "studies/optimise/design_evaluator.hpp"

#include <utility>

namespace rollres {

namespace {

constexpr int order = 2;  // truncation is far below what a search needs

/// A function of designs in place of a solution's output, as core/derivatives/gradient.hpp wants it.
template <class Function>
Objective as_objective(DesignEvaluator& evaluator, Function function) {
  const DesignProblem& problem = evaluator.problem();
  Objective objective{problem.scenes.front().scene, problem.variables, real_output("rolling_resistance"), {}};
  objective.evaluate = [&evaluator, &problem, function](const RollingScene& scene) {
    constexpr int jobs = 1;  // the columns go side by side
    const Design design = evaluator(base_point({scene, problem.variables, {}, {}}), jobs);
    RollingSolution value;
    value.reason = design.reason;
    if (!design.found()) return value;
    value.rolling_resistance = function(design);
    value.status = Status::converged;
    return value;
  };
  return objective;
}

}  // namespace

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

DesignSlopes::DesignSlopes(DesignEvaluator& evaluator, const DesignScale& scale, const Design& design)
    : scale_(scale), jobs_(evaluator.jobs()) {
  const auto add = [&](auto function) {
    Function one{as_objective(evaluator, function), {}};
    one.calibration = calibrate(one.objective, design.point, jobs_);
    functions_.push_back(std::move(one));
  };
  add([&scale](const Design& there) { return scale.value(there); });
  for (std::size_t j = 0; j < design.constraints.size(); ++j)
    add([&scale, j](const Design& there) { return scale.constraints(there)[j]; });
}

Slope DesignSlopes::of_value(const Design& design) const { return slope(functions_.front(), design); }

Slope DesignSlopes::of_constraint(const Design& design, std::size_t constraint) const {
  return slope(functions_.at(constraint + 1), design);
}

Slope DesignSlopes::slope(const Function& function, const Design& design) const {
  const Gradient there =
      gradient(function.objective, design.point, function.calibration, {.order = order, .jobs = jobs_});
  Slope slope;
  for (std::size_t i = 0; i < design.point.size(); ++i) {
    const bool found = i < there.inputs.size() && there.inputs[i].scheme != Scheme::none;
    const double size = scale_.slope(i, design.point[i]);
    slope.along.push_back(found ? there.inputs[i].derivative * size : 0);
    slope.errors.push_back(found ? there.inputs[i].error() * size : 0);
    if (found || !slope.reason.empty()) continue;
    slope.reason = "no derivative by " + std::string(function.objective.variables[i].quantity.key);
    if (!there.centre.found())
      slope.reason += ": " + there.centre.reason;
    else if (!there.inputs[i].failures.empty())
      slope.reason += ": " + there.inputs[i].failures.front().reason;
  }
  return slope;
}

}  // namespace rollres
