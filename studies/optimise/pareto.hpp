#pragma once

/// A front between two goals by the method of the epsilon constraint (Haimes, Lasdon and Wismer, 1971, IEEE Trans.
/// Syst. Man Cybern. 1, 296): the first goal at bounds of the second, swept between the ends where each is best by
/// itself.

#include <vector>

#include "studies/optimise/optimise.hpp"

namespace rollres {

struct ParetoPoint {
  OptimiseReport report;                   ///< of this point's search; its `best` is the design
  double limit = RollingSolution::absent;  ///< of the second goal [SI]; NaN at the two ends
  bool dominated = false;                  ///< another point is at least as good in both goals, and better in one
};

struct ParetoReport {
  std::vector<ParetoPoint> points;  ///< from the end of the first goal to that of the second
  bool interrupted = false;
  EvaluationCount count = {};

  bool complete() const;  ///< every point is an optimum
};

/// Bounds lie evenly, in the logarithm where both ends are positive; each search starts from the design before it.
/// @param problem  has a wish for a front
/// @throws std::runtime_error if the store fails
ParetoReport pareto_front(const DesignProblem& problem, StoredEvaluations& evaluations,
                          const OptimiseOptions& options = {});

}  // namespace rollres
