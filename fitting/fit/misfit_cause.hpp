#pragma once

/// What makes a model miss its data.

#include <string>

#include "fitting/fit/fit.hpp"

namespace rollres {

/// In words: that an offset or a scale of the measured values would explain most of a misfit (descents with it, by a
/// few of the data); or that one data set, or one end of the speeds, has most of it. Empty if nothing stands out.
/// @param report  of a fit that misses its data
std::string misfit_cause(const FitProblem& problem, const FitReport& report, const FitOptions& options);

}  // namespace rollres
