#pragma once

/// Evaluates the designs of one problem and keeps the best of them.

#include <functional>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <vector>

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

}  // namespace rollres
