#pragma once

/// Fits as JSON; null for what is absent. For sources only: it needs nlohmann_json.

#include "fitting/fit/coverage.hpp"
#include "studies/fit/fit_design.hpp"
#include "studies/fit/fit_summary.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

/// The report with parameters, profiles and data.
Json json_of(const FitReport& report, const FitContext& context);

Json json_of(const FitDesign& design, const FitReport& report);

Json json_of(const Coverage& coverage);

}  // namespace rollres
