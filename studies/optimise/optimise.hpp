#pragma once

/// Finds the best design of a problem: searches, and asks at the end whether the slopes agree. Or a front between two
/// goals by the method of the epsilon constraint (Haimes, Lasdon and Wismer, 1971, IEEE Trans. Syst. Man Cybern. 1,
/// 296): the first goal at bounds of the second, swept between the ends where each is best by itself.
///
/// A start without an answer is replaced by a point of Sobol's sequence that has one. The wanted search is
/// followed by shorter ones (slsqp, cobyla) from its best design as long as the slopes there promise more. All of it is
/// deterministic and every evaluation is recalled by its key, so that a run that was stopped, even by `kill -9`, goes
/// the same way again to the same design and solves only what is missing.
///
/// At an optimum the slope of the goal is balanced by active constraints and bounds (Karush 1939; Kuhn and Tucker 1951;
/// Nocedal and Wright, Numerical Optimization, 2006, theorem 12.1): g + sum_j lambda_j a_j + sum_i beta_i e_i = 0 with
/// lambda, beta >= 0. The multipliers are those with the smallest remainder, by non-negative least squares (Lawson and
/// Hanson, Solving Least Squares Problems, 1974, chapter 23).

#include "studies/optimise/design_search.hpp"

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

enum class DesignStatus {
  optimum,             ///< feasible, and to first order nothing near it is better: a local optimum
  unconfirmed,         ///< the searches ended, but the slopes promise more, or do not exist: `reason` tells
  evaluation_limit,    ///< the same, with all evaluations spent
  interrupted,         ///< stopped from outside
  no_feasible_design,  ///< none was seen that has an answer and meets the constraints
};
template <>
struct ChoiceNames<DesignStatus> {
  static constexpr std::array<std::string_view, 5> names{"optimum", "unconfirmed", "evaluation_limit", "interrupted",
                                                         "no_feasible_design"};
};

struct SearchReport {
  Algorithm algorithm;
  SearchEnd end;
  std::size_t evaluations;  ///< that it added
};

struct OptimiseProgress {
  EvaluationCount count;           ///< of this search
  std::optional<double> best;      ///< value of the best feasible design, of all choices [SI]
  std::size_t limit = 0;           ///< evaluations that this search may spend
  double seconds = 0;              ///< since it began
  std::size_t place = 1, all = 1;  ///< of its problem among those that are chosen from
};

struct OptimiseOptions {
  int jobs = 0;                                              ///< as in DesignEvaluator
  std::function<void(const OptimiseProgress&)> report = {};  ///< after each design
};

struct OptimiseReport {
  DesignStatus status = DesignStatus::no_feasible_design;
  std::string reason = {};              ///< why it is not an optimum
  std::optional<Design> best = {};      ///< the best feasible design seen
  std::optional<Design> nearest = {};   ///< without one: that with the smallest excess over its constraints
  std::optional<Optimum> optimum = {};  ///< of `best`; absent after an interruption
  std::vector<SearchReport> searches = {};
  EvaluationCount count = {};         ///< all, those of earlier searches with the same evaluations left out
  std::size_t slope_evaluations = 0;  ///< of these, for the slopes at the end
  std::vector<Design> designs = {};   ///< all with a value, in the order in which they came

  double value() const { return best ? best->value : RollingSolution::absent; }
};

/// The algorithm for a problem that names none: direct_l where a global search is wanted, cobyla with constraints or
/// one variable, else bobyqa.
Algorithm default_algorithm(const DesignProblem& problem);

/// Evaluations that its searches may spend.
std::size_t evaluation_limit(const DesignProblem& problem);

/// @throws std::runtime_error if the store fails
OptimiseReport optimise(const DesignProblem& problem, StoredEvaluations& evaluations,
                        const OptimiseOptions& options = {});

struct ParetoPoint {
  OptimiseReport report;                   ///< of this point's search; its `best` is the design
  double limit = RollingSolution::absent;  ///< of the second goal [SI]; NaN at the two ends
  bool dominated = false;                  ///< another point is at least as good in both goals, and better in one
  std::size_t choice = 0;                  ///< place of its problem among those that are chosen from
};

struct ParetoReport {
  std::vector<ParetoPoint> points;  ///< from the end of the first goal to that of the second
  bool interrupted = false;
  bool conflict = true;  ///< false: one design is the best for both goals, and there is no front between them
  EvaluationCount count = {};

  bool complete() const;  ///< every point is an optimum
  bool any() const;       ///< a point has a design
};

/// Bounds lie evenly, in the logarithm where both ends are positive; each search starts from the design before it.
/// @param problem  has a wish for a front
/// @throws std::runtime_error if the store fails
ParetoReport pareto_front(const DesignProblem& problem, StoredEvaluations& evaluations,
                          const OptimiseOptions& options = {});

/// The front of what is chosen from lists: that of each choice, and of all their points those that none dominates.
/// Points stand in the order of the first goal.
/// @param problems  of one file, at least one
ParetoReport pareto_front(std::span<const DesignProblem> problems, StoredEvaluations& evaluations,
                          const OptimiseOptions& options = {});

}  // namespace rollres
