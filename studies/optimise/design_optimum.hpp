#pragma once

/// Whether a design is an optimum to first order, and what it depends on.
///
/// At an optimum the slope of the goal is balanced by active constraints and bounds (Karush 1939; Kuhn and Tucker 1951;
/// Nocedal and Wright, Numerical Optimization, 2006, theorem 12.1): g + sum_j lambda_j a_j + sum_i beta_i e_i = 0 with
/// lambda, beta >= 0. The multipliers are those with the smallest remainder, by non-negative least squares (Lawson and
/// Hanson, Solving Least Squares Problems, 1974, chapter 23).

#include <array>
#include <string>
#include <vector>

#include "studies/optimise/design_evaluator.hpp"

namespace rollres {

enum class ActiveBound { none, lowest, highest };
template <>
struct ChoiceNames<ActiveBound> {
  static constexpr std::array<std::string_view, 3> names{"none", "lowest", "highest"};
};

/// What one function of the design changes by with each variable.
struct Elasticities {
  std::vector<double> of;      ///< d ln function / d ln variable [1]; NaN where one of them is 0
  std::vector<double> errors;  ///< estimated [1]
};

struct ConstraintState {
  double slack = 0;                ///< how far it is from its limit, relative [1]; negative if it is broken
  bool active = false;             ///< slack nearly 0
  double multiplier = 0;           ///< what 1 % more room would bring the goal, in % (where both are positive)
  Elasticities elasticities = {};  ///< of left / right, or of left - right where those are not positive
};

struct Optimum {
  Elasticities goal;
  std::vector<ConstraintState> constraints;
  std::vector<ActiveBound> bounds;  ///< of the variables
  /// What the slopes still promise, relative: by moves of 1 % of the box, and by the slack in active constraints.
  double promise = 0;
  std::string reason = {};  ///< why this is not known to be an optimum; empty if it is

  bool confirmed() const { return reason.empty(); }
};

/// @param slopes  made at this design
/// @param tolerance  of the search, as a fraction of the box
/// @throws what the evaluator of the slopes throws
Optimum examine_optimum(const DesignProblem& problem, const DesignScale& scale, const DesignSlopes& slopes,
                        const Design& design, double tolerance);

}  // namespace rollres
