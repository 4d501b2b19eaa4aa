#pragma once

/// What a fit's file says of the next measurement. For sources only: it needs nlohmann_json.
///
///     "design": {"ranges": {"speed": {"from": "1 mm/s", "to": "10 m/s"}},
///                "targets": [{"speed": "4 m/s", "temperature": "-20 degC", "data": "drum"}], "points": 3}
///
/// `ranges`: in which measurements can be made, beside what varies in the data. `targets`: scenes whose predicted
/// output is to be known better, each with inputs in place of those of the data set `data` (default: the first);
/// without any, the parameters are. `points`: as many are named together.

#include "studies/fit/fit_file.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

/// @param fit  with its data and parameters
/// @throws std::invalid_argument one line naming file, key, value and rule
DesignWish read_design(const Json& object, const FitFile& fit, const std::string& place);

}  // namespace rollres
