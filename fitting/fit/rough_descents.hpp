#pragma once

/// The descents of a fit down to where the exact ones go on. They use few of the data before all.

#include <vector>

#include "fitting/descent/descent.hpp"
#include "fitting/fit/fit.hpp"

namespace rollres {

/// A descent that will be gone on with: in logarithms of what is positive; first by a few rows; by slopes that cost
/// half as much, evaluated only where secants are not good enough; and no farther than they are worth.
Descent rough_descent(const FitProblem& problem, const FitPoint& start, const FitOptions& options);

/// Rough descents from all starts. Those that end where another did are not followed further, nor those that end far
/// above it. Where the first ends at a place that no longer feels one of the parameters, others begin there with usual
/// values of that one; so for one that saturates, unless two agree on it. Rows without an answer where the best by a
/// few rows ended join the few, and all begins anew. Where it explains the data and leaves a direction of several
/// parameters free, it is the last.
std::vector<Descent> rough_descents(const FitProblem& problem, const FitOptions& options);

}  // namespace rollres
