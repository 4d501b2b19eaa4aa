#include "studies/optimise/design_scale.hpp"

#include <algorithm>
#include <cmath>

namespace rollres {

namespace {

/// ln x, continued by its tangent below `least`, where a quantity that is positive as a rule is not.
double logarithm(double x) {
  constexpr double least = 1e-3;
  return x > least ? std::log(x) : std::log(least) + (x - least) / least;
}

double size_or_one(double size) { return size > 0 ? size : 1; }

}  // namespace

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
