#pragma once

/// Findings of a fit as sentences.

#include <string>

#include "fitting/fit/fit_report.hpp"

namespace rollres {

/// "static_shear_modulus x 1.35 with creep_time x 0.74 raises chi squared by 1".
std::string weakest_direction_in_words(const FitProblem& problem, const FitErrors& errors);

/// The parameters that share the weakest direction: "static_shear_modulus and creep_time".
std::string weakest_parameters(const FitProblem& problem, const FitErrors& errors);

/// Four significant digits.
std::string rounded(double value);

}  // namespace rollres
