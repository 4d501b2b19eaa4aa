#pragma once

/// Fits a model's parameters to measured values: several descents, the errors at the best, and a judgement.

#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

#include "fitting/descent/fit_problem.hpp"
#include "fitting/descent/secant_slopes.hpp"
#include "fitting/fit/fit_report.hpp"

namespace rollres {

inline constexpr double confidence = 0.95;  ///< of all intervals

/// Solutions that a fit is usually worth: 3,000, or 60 for each datum, or what its limits say. It is no limit, but with
/// so many no profile begins, and none is worth more than a sixth of them more.
std::size_t usual_solutions(const FitProblem& problem, const FitLimits& limits);

struct FitOptions {
  int starts = 1;          ///< 1: the given one; else so many of those that promise most (fit_starts.hpp)
  double reach = 5;        ///< largest factor between the given start and the others
  std::uint64_t seed = 1;  ///< of the hypercube
  bool profiles = true;    ///< intervals by profile likelihood, as long as solutions are left for them
  /// Slopes at or near the start that are known already: for many fits to much the same data.
  std::optional<KnownSlopes> known = {};
  const std::atomic<bool>* stop = nullptr;  ///< set from outside: return what is known so far
  FitLimits limits = {};
};

/// @throws std::invalid_argument if the data are too few, or the start of a parameter is outside its bounds
FitReport fit(const FitProblem& problem, const FitOptions& options = {});

/// The report on a point that a descent led to: errors, tests, status, without profiles.
/// @param ends    all descents, for their agreement
/// @param slopes  at the point or close beside it; none: they are evaluated
FitReport report_on(const FitProblem& problem, const Descent& best, const std::vector<Descent>& ends,
                    const std::optional<Slopes>& slopes = {});

/// What follows from the covariance of a report's errors: deviations, correlations, errors and linear intervals of the
/// parameters, bands of the values.
void tell_errors(FitReport& report, const FitProblem& problem);

/// The rise of the misfit, over its scale, at the ends of an interval: the square of the two-sided quantile, normal
/// where deviations are known, else Student's.
double interval_threshold(bool deviations_known, int degrees);
double interval_threshold(const FitProblem& problem);

/// Sets status and reason from what the report holds.
void judge(FitReport& report, const FitProblem& problem);

}  // namespace rollres
