#pragma once

/// The coverage of a fit's intervals as text and as JSON. For sources only: it needs nlohmann_json.

#include <string>

#include "fitting/fit/coverage.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

/// How many intervals of the draws hold the truth.
std::string coverage_summary(const Coverage& coverage);

Json json_of(const Coverage& coverage);

}  // namespace rollres
