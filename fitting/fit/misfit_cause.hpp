#pragma once

/// What makes a model miss its data.

#include <string>

#include "fitting/fit/fit.hpp"

namespace rollres {

/// In words: that an offset or a scale of the measured values would explain most of a misfit (descents with it, by a
/// few of the data); empty if neither would.
/// @param report  of a fit that misses its data
std::string missing_term(const FitProblem& problem, const FitReport& report, const FitOptions& options);

/// In words: that one data set, or one end of the speeds, has most of the misfit; empty if nothing stands out.
std::string place_of_misfit(const FitReport& report);

}  // namespace rollres
