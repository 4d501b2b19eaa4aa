#include "studies/optimise/design.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/parallel.hpp"
#include "db/rows/result_store.hpp"
#include "db/rows/schema.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

namespace {

double combined(const DesignProblem& problem, const Formula& formula, const std::vector<RollingScene>& scenes,
                const std::vector<RollingSolution>& solutions) {
  std::optional<double> all;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const double one = problem.scenes[i].weight * formula(scenes[i], solutions[i]);
    if (!all)
      all = one;
    else if (problem.over_scenes == OverScenes::sum)
      *all += one;
    else
      *all = std::max(*all, one);  // NaN is found by the caller: the sum of all
  }
  return *all;
}

std::string place_of(const DesignProblem& problem, std::size_t scene) {
  return problem.scenes.size() == 1 ? "" : "scene " + std::to_string(scene + 1) + ": ";
}

/// ln x, continued by its tangent below `least`, where a quantity that is positive as a rule is not.
double logarithm(double x) {
  constexpr double least = 1e-3;
  return x > least ? std::log(x) : std::log(least) + (x - least) / least;
}

double size_or_one(double size) { return size > 0 ? size : 1; }

}  // namespace

std::string DesignProblem::variant() const {
  for (const ChosenValue& one : chosen)
    if (one.key == variant_key) return std::get<std::string>(one.value);
  return {};
}

bool Design::feasible() const {
  return found() && std::all_of(constraints.begin(), constraints.end(), [](const auto& sides) { return sides.holds; });
}

std::vector<RollingScene> scenes_at(const DesignProblem& problem, std::span<const double> point) {
  std::vector<RollingScene> scenes;
  for (const DutyScene& duty : problem.scenes) {
    const Objective there{duty.scene, problem.variables, {}, {}};
    scenes.push_back(scene_at(there, point));
  }
  return scenes;
}

Design evaluate_design(const DesignProblem& problem, std::span<const double> point, const Evaluate& evaluate,
                       int jobs) {
  Design design{{point.begin(), point.end()}};
  const std::vector<RollingScene> scenes = scenes_at(problem, point);
  std::vector<RollingSolution> solutions(scenes.size());
  for_each_piece(scenes.size(), jobs, [&](std::size_t i) { solutions[i] = evaluate(scenes[i]); });

  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const RollingSolution& solution = solutions[i];
    design.keys.push_back(evaluation_key(scenes[i]));
    if (design.found() && solution.status != Status::converged)
      design.reason =
          place_of(problem, i) + (solution.reason.empty() ? std::string(name_of(solution.status)) : solution.reason);
    for (const Condition& condition : problem.constraints)
      design.constraints.push_back({condition.left()(scenes[i], solution), condition.right()(scenes[i], solution),
                                    condition.at_most(), condition.holds(scenes[i], solution)});
  }
  const auto value_of = [&](const Formula& formula) {
    for (std::size_t i = 0; i < scenes.size() && design.found(); ++i)
      if (!std::isfinite(formula(scenes[i], solutions[i])))
        design.reason = place_of(problem, i) + formula.text() + ": has no finite value";
    return design.found() ? combined(problem, formula, scenes, solutions) : RollingSolution::absent;
  };
  design.value = value_of(problem.goal.formula);
  if (problem.pareto) design.second = value_of(problem.pareto->goal.formula);
  if (problem.bound) {
    const auto& [goal, limit] = *problem.bound;
    const double value = value_of(goal.formula);
    design.constraints.push_back({value, limit, !goal.maximise, goal.maximise ? value >= limit : value <= limit});
  }
  for (std::size_t j = 0; j < design.constraints.size() && design.found(); ++j)
    if (!std::isfinite(design.constraints[j].left) || !std::isfinite(design.constraints[j].right))
      design.reason = constraint_name(problem, j) + ": has no finite value";
  if (!design.found()) design.value = design.second = RollingSolution::absent;
  return design;
}

std::string constraint_name(const DesignProblem& problem, std::size_t constraint) {
  const std::size_t own = problem.constraints.size();
  if (constraint >= own * problem.scenes.size())
    return problem.bound->goal.formula.text() + (problem.bound->goal.maximise ? " >= " : " <= ") +
           short_number(problem.bound->limit);
  const std::string& text = problem.constraints[constraint % own].text();
  return problem.scenes.size() == 1 ? text : text + ", scene " + std::to_string(constraint / own + 1);
}

std::vector<double> point_in_box(const DesignProblem& problem, std::span<const double> place) {
  std::vector<double> point;
  for (std::size_t i = 0; i < place.size(); ++i) {
    const Variable& variable = problem.variables[i];
    const double lowest = variable.scaled(variable.lowest), highest = variable.scaled(variable.highest);
    const double part = std::clamp(place[i], 0.0, 1.0);
    if (part == 0 || part == 1)
      point.push_back(part == 0 ? variable.lowest : variable.highest);  // without rounding
    else
      point.push_back(variable.value(lowest + part * (highest - lowest)));
  }
  return point;
}

DesignScale::DesignScale(const DesignProblem& problem, const Design& reference)
    : problem_(problem), value_side_{reference.value > 0, size_or_one(std::abs(reference.value))} {
  for (const ConstraintSides& sides : reference.constraints) {
    const bool both_positive = sides.left > 0 && sides.right > 0;
    constraint_sides_.push_back(
        {both_positive,
         both_positive ? sides.right : size_or_one(std::max(std::abs(sides.left), std::abs(sides.right)))});
  }
}

std::vector<double> DesignScale::to_box(std::span<const double> point) const {
  std::vector<double> place;
  for (std::size_t i = 0; i < point.size(); ++i) {
    const Variable& variable = problem_.variables[i];
    const double lowest = variable.scaled(variable.lowest), highest = variable.scaled(variable.highest);
    place.push_back(std::clamp((variable.scaled(point[i]) - lowest) / (highest - lowest), 0.0, 1.0));
  }
  return place;
}

double DesignScale::slope(std::size_t i, double value) const {
  const Variable& variable = problem_.variables[i];
  return variable.slope(value) * (variable.scaled(variable.highest) - variable.scaled(variable.lowest));
}

double DesignScale::value(const Design& design) const {
  const double relative = design.value / value_side_.size;
  const double scaled = value_side_.logarithmic ? logarithm(relative) : relative;
  return problem_.goal.maximise ? -scaled : scaled;
}

std::vector<double> DesignScale::constraints(const Design& design) const {
  std::vector<double> all;
  for (std::size_t j = 0; j < design.constraints.size(); ++j) {
    const auto& [left, right, at_most, holds] = design.constraints[j];
    const auto& [logarithmic, size] = constraint_sides_[j];
    const double excess = logarithmic ? logarithm(left / size) - logarithm(right / size) : (left - right) / size;
    all.push_back(at_most ? excess : -excess);
  }
  return all;
}

}  // namespace rollres
