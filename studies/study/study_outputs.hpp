#pragma once

/// Reads what is wanted of a study: "constraints", "compute", "chart" and "charts" of its file. For sources only: it
/// needs nlohmann_json.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "studies/study/study.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

/// Keys of the outputs that are numbers: what a chart can show.
std::vector<std::string_view> number_outputs();

/// @param place      the file
/// @param indenters  the bodies of the study, whose units must hold in every condition
/// @throws std::invalid_argument naming place, condition and rule
std::vector<Condition> study_constraints(const Json& study, std::span<const Indenter> indenters,
                                         const std::string& place);

/// The outputs under "compute"; none where the file says nothing.
/// @throws std::invalid_argument naming place, key, value and rule
std::vector<std::string> study_outputs(const Json& study, const std::string& place);

/// The charts under "chart" or "charts".
/// @throws std::invalid_argument naming place, key, value and rule
std::vector<StudyChart> study_charts(const Json& study, const std::vector<Axis>& axes, const std::string& place);

}  // namespace rollres
