#include "studies/optimise/design.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/parallel.hpp"
#include "db/rows/result_store.hpp"
#include "db/rows/schema.hpp"
#include "studies/scene_io/scene_inputs.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

namespace {

/// The numbers of the scenes as one.
double combined(const DesignProblem& problem, OverScenes over, const std::vector<double>& values) {
  double sum = 0, weights = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    sum += problem.scenes[i].weight * values[i];
    weights += problem.scenes[i].weight;
  }
  if (!std::isfinite(sum)) return RollingSolution::absent;
  switch (over) {
    case OverScenes::sum:
      return sum;
    case OverScenes::mean:
      return sum / weights;
    case OverScenes::max:
      return *max_element(values);
    case OverScenes::min:
      break;
  }
  return *min_element(values);
}

/// The scenes of a design with their answers.
struct AnsweredScenes {
  const DesignProblem& problem;
  const std::vector<RollingScene>& scenes;
  std::vector<RollingSolution> solutions;

  double value(const Formula& formula, std::size_t scene, std::size_t point) const {
    const std::size_t place = scene * problem.scatter_points() + point;
    return formula(scenes[place], solutions[place]);
  }
  /// Of one scene.
  double value(const Formula& formula, std::size_t scene, const ScatterMeasure& scatter) const {
    std::vector<double> values;
    for (std::size_t point = 0; point < problem.scatter_points(); ++point)
      values.push_back(value(formula, scene, point));
    return measured(values, scatter);
  }
  /// Over all scenes.
  double value(const Formula& formula, OverScenes over, const ScatterMeasure& scatter) const {
    std::vector<double> values;
    for (std::size_t point = 0; point < problem.scatter_points(); ++point) {
      std::vector<double> of_scenes;
      for (std::size_t scene = 0; scene < problem.scenes.size(); ++scene)
        of_scenes.push_back(value(formula, scene, point));
      values.push_back(combined(problem, over, of_scenes));
    }
    return measured(values, scatter);
  }
  /// All rolling resistances larger by their errors: a material leaves those of all scenes open alike.
  void add_errors() {
    for (RollingSolution& solution : solutions) {
      const double error = solution.rolling_resistance_error;
      if (!(error > 0)) continue;
      if (solution.load > 0) solution.rolling_resistance_coefficient += error / solution.load;
      solution.rolling_resistance += error;
    }
  }

 private:
  /// A value that is missing makes the whole missing.
  double measured(const std::vector<double>& values, const ScatterMeasure& scatter) const {
    if (!problem.uncertain.any()) return values.front();
    for (const double value : values)
      if (!std::isfinite(value)) return RollingSolution::absent;
    return scatter(values);
  }
};

ConstraintSides sides_of(const AnsweredScenes& answered, const ConstraintPlace& place) {
  const DesignConstraint& constraint = answered.problem.constraints[place.constraint];
  ConstraintSides sides{.at_most = constraint.at_most()};
  sides.left = place.scene ? answered.value(constraint.left(), *place.scene, constraint.scatter)
                           : answered.value(constraint.left(), *constraint.over, constraint.scatter);
  sides.right = answered.value(constraint.right(), place.scene.value_or(0), std::size_t{0});
  sides.holds = constraint.holds_with(sides.at_most ? sides.left - sides.right : sides.right - sides.left);
  return sides;
}

/// Of a scene of a design, for messages.
std::string place_of(const DesignProblem& problem, std::size_t place) {
  const std::size_t points = problem.scatter_points();
  std::string text;
  if (problem.scenes.size() > 1) text = "scene " + std::to_string(place / points + 1) + ": ";
  if (points > 1) text += "point " + std::to_string(place % points + 1) + " of the scatter: ";
  return text;
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

std::string DesignProblem::in_words(const ChosenValue& value) const {
  if (const auto* const name = std::get_if<std::string>(&value.value)) return *name;
  const Quantity& quantity = find_input(value.key)->quantity;
  return readable(quantity, std::get<double>(value.value), unit(quantity));
}

bool Design::feasible() const {
  return found() && all_of(constraints, [](const auto& sides) { return sides.holds; });
}

std::vector<RollingScene> scenes_at(const DesignProblem& problem, std::span<const double> point) {
  std::vector<RollingScene> scenes;
  for (const DutyScene& duty : problem.scenes) {
    const Objective there{duty.scene, problem.variables, {}, {}};
    const RollingScene scene = scene_at(there, point);
    for (std::size_t k = 0; k < problem.scatter_points(); ++k) {
      scenes.push_back(scene);
      for (std::size_t i = 0; i < problem.uncertain.inputs.size(); ++i) {
        const UncertainInput& input = problem.uncertain.inputs[i];
        const Distribution distribution = input.around(input.relative ? real_input(scene, input.key) : 1);
        set_input(scenes.back(), input.key, quantile(distribution, problem.uncertain_points[i][k]));
      }
    }
  }
  return scenes;
}

Design evaluate_design(const DesignProblem& problem, std::span<const double> point, const Evaluate& evaluate,
                       int jobs) {
  Design design{{point.begin(), point.end()}};
  const std::vector<RollingScene> scenes = scenes_at(problem, point);
  AnsweredScenes answered{problem, scenes, std::vector<RollingSolution>(scenes.size())};
  for_each_piece(scenes.size(), jobs, [&](std::size_t i) { answered.solutions[i] = evaluate(scenes[i]); });

  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const RollingSolution& solution = answered.solutions[i];
    design.keys.push_back(evaluation_key(scenes[i]));
    for (const std::string& warning : solution.warnings)
      if (std::find(design.warnings.begin(), design.warnings.end(), warning) == design.warnings.end())
        design.warnings.push_back(warning);
    if (!(std::abs(design.model_error) >= std::abs(solution.model_error)) && std::isfinite(solution.model_error))
      design.model_error = solution.model_error;
    if (design.found() && solution.status != Status::converged)
      design.reason =
          place_of(problem, i) + (solution.reason.empty() ? std::string(name_of(solution.status)) : solution.reason);
  }
  for (const ConstraintPlace& place : constraint_places(problem))
    design.constraints.push_back(sides_of(answered, place));
  const auto value_of = [&](const Goal& goal) {
    for (std::size_t i = 0; i < scenes.size() && design.found(); ++i)
      if (!std::isfinite(goal.formula(scenes[i], answered.solutions[i])))
        design.reason = place_of(problem, i) + goal.formula.text() + ": has no finite value";
    return design.found() ? answered.value(goal.formula, goal.over, goal.scatter) : RollingSolution::absent;
  };
  design.value = value_of(problem.goal);
  if (problem.pareto) design.second = value_of(problem.pareto->goal);
  if (problem.bound) {
    const auto& [goal, limit] = *problem.bound;
    const double value = value_of(goal);
    design.constraints.push_back({value, limit, !goal.maximise, goal.maximise ? value >= limit : value <= limit});
  }
  for (std::size_t j = 0; j < design.constraints.size() && design.found(); ++j)
    if (!std::isfinite(design.constraints[j].left) || !std::isfinite(design.constraints[j].right))
      design.reason = constraint_name(problem, j) + ": has no finite value";
  if (!design.found()) {
    design.value = design.second = RollingSolution::absent;
    return design;
  }
  answered.add_errors();
  design.error = std::abs(answered.value(problem.goal.formula, problem.goal.over, problem.goal.scatter) - design.value);
  return design;
}

std::vector<ConstraintPlace> constraint_places(const DesignProblem& problem) {
  std::vector<ConstraintPlace> places;
  for (std::size_t scene = 0; scene < problem.scenes.size(); ++scene)
    for (std::size_t i = 0; i < problem.constraints.size(); ++i)
      if (!problem.constraints[i].over) places.push_back({i, scene});
  for (std::size_t i = 0; i < problem.constraints.size(); ++i)
    if (problem.constraints[i].over) places.push_back({i});
  return places;
}

namespace {

std::string over_in_words(const DesignProblem& problem, OverScenes over) {
  if (problem.scenes.size() == 1) return {};
  const bool weighted = over == OverScenes::sum || over == OverScenes::mean;
  return ", " + std::string(weighted ? "weighted " : "") + std::string(name_of(over)) + " over " +
         std::to_string(problem.scenes.size()) + " scenes";
}

std::string scatter_in_words(const DesignProblem& problem, const ScatterMeasure& scatter) {
  if (!problem.uncertain.any()) return {};
  return ", " + scatter.text() + " of " + std::to_string(problem.scatter_points()) + " points";
}

}  // namespace

std::string measure_in_words(const DesignProblem& problem, const Goal& goal) {
  return over_in_words(problem, goal.over) + scatter_in_words(problem, goal.scatter);
}

std::string constraint_name(const DesignProblem& problem, std::size_t constraint) {
  const std::vector<ConstraintPlace> places = constraint_places(problem);
  if (constraint >= places.size()) {
    const auto& [goal, limit] = *problem.bound;
    return goal.formula.text() + (goal.maximise ? " >= " : " <= ") + short_number(limit) +
           measure_in_words(problem, goal);
  }
  const auto& [place, scene] = places[constraint];
  const DesignConstraint& own = problem.constraints[place];
  std::string text = own.text();
  if (own.over) text += over_in_words(problem, *own.over);
  if (scene && problem.scenes.size() > 1) text += ", scene " + std::to_string(*scene + 1);
  return text + scatter_in_words(problem, own.scatter);
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
