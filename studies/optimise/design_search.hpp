#pragma once

/// One search of NLopt in the unit box of a design problem.
///
/// NLopt's own word is not trusted: the best design is the one that the evaluator has seen. A design without a value
/// gets a finite penalty, above every value seen and rising with the distance from the best place, so that neither NaN
/// nor an exception ever reaches NLopt.
///
/// Constraints c <= 0 are left to NLopt where the algorithm takes them (cobyla, slsqp, mma, ccsaq). Algorithms with a
/// smooth model of the goal (bobyqa, lbfgs) work under NLopt's augmented Lagrangian (Birgin and Martínez, 2008, Optim.
/// Methods Softw. 23, 177). The others bear a kink and take the exact penalty 10 sum max(0, c): in the scaled terms of
/// DesignScale multipliers are of the order of 1, and where one is larger the slopes at the end tell
/// (optimise.hpp).

#include "studies/optimise/design_evaluator.hpp"

namespace rollres {

/// What is known of an algorithm.
struct AlgorithmTraits {
  bool global = false;           ///< needs no start, ends by its limit
  bool slopes = false;           ///< needs DesignSlopes
  bool own_constraints = false;  ///< takes them itself
  std::size_t fewest_variables = 1;
};
AlgorithmTraits traits(Algorithm algorithm);

struct SearchOptions {
  Algorithm algorithm = Algorithm::cobyla;
  double step = 0.1;          ///< of the first moves, as a fraction of the box
  double tolerance = 1e-4;    ///< in the place, as a fraction of the box
  std::size_t evaluations{};  ///< the search ends once the evaluator's count has reached this number
};

/// How a search ended.
enum class SearchEnd {
  tolerance,  ///< by the algorithm's own rules
  limit,      ///< all evaluations spent
  failed      ///< the algorithm could not go on; rounding as a rule
};

/// @param slopes  may be null for algorithms that need none
/// @throws Interrupted, and what the store throws
SearchEnd search(DesignEvaluator& evaluator, const DesignScale& scale, const Design& start,
                 const SearchOptions& options, const DesignSlopes* slopes = nullptr);

}  // namespace rollres
