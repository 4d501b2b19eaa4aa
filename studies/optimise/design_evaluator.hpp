#pragma once

/// Evaluates the designs of one problem and keeps the best of them; slopes of its goal and its constraints along the
/// sides of the unit box, by the finite differences of core/derivatives/gradient.hpp, whose steps suit the noise that
/// is measured once.

#include <set>

#include "core/derivatives/gradient.hpp"
#include "studies/optimise/design.hpp"
#include "studies/run/stored_evaluations.hpp"

namespace rollres {

/// May be called by several threads at once. Which design is the best does not depend on their order.
class DesignEvaluator {
 public:
  /// @param jobs    threads for the scenes of a design and for the columns of a gradient; 0: one for each core
  /// @param report  called after each design, by one thread at a time
  DesignEvaluator(const DesignProblem& problem, StoredEvaluations& evaluations, int jobs = 0,
                  std::function<void()> report = {});

  const DesignProblem& problem() const { return problem_; }
  int jobs() const { return jobs_; }
  EvaluationCount count() const { return evaluations_.count(); }

  /// @throws Interrupted, and what the store throws
  Design operator()(std::span<const double> point, int jobs);
  Design operator()(std::span<const double> point) { return (*this)(point, jobs_); }

  /// The best feasible design so far; of equal ones the one with the smallest variables.
  std::optional<Design> best() const;
  /// Every design so far that has a value, feasible or not, once and in the order in which they came.
  std::vector<Design> designs() const;

 private:
  const DesignProblem& problem_;
  StoredEvaluations& evaluations_;
  int jobs_;
  std::function<void()> report_;
  mutable std::mutex mutex_, reporting_;
  std::optional<Design> best_;
  std::vector<Design> designs_;
  std::set<std::vector<double>> seen_;  // points of these
};

/// The gradient of one scaled function (DesignScale) [1].
struct Slope {
  std::vector<double> along;   ///< d function / d place; 0 where no formula found values at all its points
  std::vector<double> errors;  ///< estimated
  std::string reason = {};     ///< why one is missing; empty if all are there
};

class DesignSlopes {
 public:
  /// Measures noise and bending at a design that has a value. The evaluator and the scale must outlive it.
  /// @throws what the evaluator throws
  DesignSlopes(DesignEvaluator& evaluator, const DesignScale& scale, const Design& design);

  Slope of_value(const Design& design) const;
  /// @param constraint  place in Design::constraints
  Slope of_constraint(const Design& design, std::size_t constraint) const;

 private:
  struct Function {
    Objective objective;
    Calibration calibration;
  };
  Slope slope(const Function& function, const Design& design) const;

  const DesignScale& scale_;
  int jobs_;
  std::vector<Function> functions_;  // of the value, then of the constraints
};

}  // namespace rollres
