#pragma once

/// Where the descents of a fit begin.
///
/// Points to begin with are the given start, what closed forms suggest, and a Latin hypercube around these, or over the
/// usual values of a quantity. The closed form where there is one, then a few of the data tell which are worth a
/// descent.

#include <vector>

#include "fitting/descent/descent.hpp"
#include "fitting/fit/fit.hpp"

namespace rollres {

/// Rows that a descent from afar can do with: few, spread over the table without a period that it could share, and all
/// that was known before; none where all are not many more.
std::vector<std::size_t> few_rows(const FitProblem& problem);

/// Whether all parameters of two points are nearer than a distance, scaled.
bool beside(const FitProblem& problem, const FitPoint& a, const FitPoint& b, double distance);

/// What a parameter's values are looked for between, scaled.
struct UsualSpan {
  double lowest, highest;
};
std::vector<UsualSpan> spans_of(const FitProblem& problem, const FitOptions& options);

/// The problem of a few rows that a descent from afar can do with, or the whole where it has few.
FitProblem small_problem(const FitProblem& problem);

/// Points to descend from, the most promising first, no two within a factor of 2 of each other in all parameters;
/// options.starts of them at most, the given one among them where it has an answer.
std::vector<FitPoint> starts_of(const FitProblem& problem, const FitOptions& options);

}  // namespace rollres
