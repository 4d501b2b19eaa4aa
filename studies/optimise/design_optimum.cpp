#include "studies/optimise/optimise.hpp"

#include <cmath>

#include "core/algebra/dense_algebra.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

namespace {

/// From slopes along the box to d ln f / d ln x, or d f / d ln x where the scaled function is no logarithm.
Elasticities elasticities_of(const Slope& slope, const DesignScale& scale, const Design& design, double sign) {
  Elasticities all;
  for (std::size_t i = 0; i < design.point.size(); ++i) {
    const double value = design.point[i];
    const double factor =
        slope.reason.empty() && value != 0 ? sign * value / scale.slope(i, value) : RollingSolution::absent;
    all.of.push_back(slope.along[i] * factor);
    all.errors.push_back(slope.errors[i] * std::abs(factor));
  }
  return all;
}

}  // namespace

Optimum examine_optimum(const DesignProblem& problem, const DesignScale& scale, const DesignSlopes& slopes,
                        const Design& design, double tolerance) {
  // Searches end this close to bounds and constraints, in units of their tolerance.
  constexpr double nearness = 20;
  constexpr double move = 0.01, largest_promise = 5e-4;
  const double near = nearness * tolerance;
  const std::size_t size = design.point.size();
  Optimum optimum;

  const Slope goal = slopes.of_value(design);
  optimum.goal = elasticities_of(goal, scale, design, problem.goal.maximise ? -1 : 1);
  optimum.reason = goal.reason;
  std::vector<std::vector<double>> columns;
  std::vector<double> down;
  for (const double along : goal.along) down.push_back(-along);

  const std::vector<double> excess = scale.constraints(design);
  std::vector<double> room;  // up to the limit of each column, relative
  for (std::size_t j = 0; j < excess.size(); ++j) {
    const Slope slope = slopes.of_constraint(design, j);
    ConstraintState state{.slack = -excess[j], .active = std::abs(excess[j]) <= near};
    state.elasticities = elasticities_of(slope, scale, design, design.constraints[j].at_most ? 1 : -1);
    optimum.constraints.push_back(state);
    if (!state.active) continue;
    if (optimum.reason.empty() && !slope.reason.empty())
      optimum.reason = constraint_name(problem, j) + ": " + slope.reason;
    columns.push_back(slope.along);
    room.push_back(std::abs(excess[j]));
  }

  const std::vector<double> place = scale.to_box(design.point);
  for (std::size_t i = 0; i < size; ++i) {
    const bool low = place[i] <= near, high = place[i] >= 1 - near;
    optimum.bounds.push_back(low ? ActiveBound::lowest : high ? ActiveBound::highest : ActiveBound::none);
    if (!low && !high) continue;
    columns.emplace_back(size, 0);
    columns.back()[i] = low ? -1 : 1;
    room.push_back(low ? place[i] : 1 - place[i]);
  }

  Eigen::MatrixXd slopes_of_active(size, columns.size());
  for (std::size_t k = 0; k < columns.size(); ++k)
    slopes_of_active.col(static_cast<Eigen::Index>(k)) = Eigen::Map<const Eigen::VectorXd>(columns[k].data(), size);
  const Eigen::VectorXd multipliers =
      nonnegative_least_squares(slopes_of_active, Eigen::Map<const Eigen::VectorXd>(down.data(), size));
  for (std::size_t i = 0; i < size; ++i) {
    double rest = down[i];
    for (std::size_t k = 0; k < columns.size(); ++k) rest -= multipliers[k] * columns[k][i];
    optimum.promise += move * std::abs(rest);
  }
  for (std::size_t k = 0; k < columns.size(); ++k) optimum.promise += multipliers[k] * room[k];
  std::size_t column = 0;
  for (ConstraintState& state : optimum.constraints)
    if (state.active) state.multiplier = multipliers[column++];
  if (optimum.reason.empty() && !design.feasible()) optimum.reason = "breaks a constraint";
  if (optimum.reason.empty() && optimum.promise > largest_promise)
    optimum.reason =
        "the slopes promise " + short_number(100 * optimum.promise, 2) + " % more within 1 % of the ranges";
  return optimum;
}

}  // namespace rollres
