#pragma once

/// How long a study will take where nothing of it is stored: a few of its points are solved, and thrown away. What is
/// predicted from inputs alone (predicted_cost.hpp) may be off by far, for nobody knows beforehand how often a grid is
/// halved, or how many terms a measured material has.

#include "core/solve/rolling_contact.hpp"
#include "studies/study/study.hpp"

namespace rollres {

struct ProbedCost {
  double seconds_each = 0;  ///< of a point, on one core: mean of those solved, the first left out if it is not alone
  std::size_t points = 0;   ///< that were solved
};

/// Solves points spread evenly over the plan, the first of each half before those of each quarter, until `budget`
/// seconds are over or 48 are solved. None takes longer than 10 s.
ProbedCost probed_cost(const Study& study, const Evaluate& evaluate, double budget = 1.5);

}  // namespace rollres
