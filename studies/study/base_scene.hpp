#pragma once

/// The scene that a study varies. For sources only: it needs nlohmann_json.

#include <string>
#include <vector>

#include "studies/study/study_axes.hpp"

namespace rollres {

/// The scene at the first values of the axes, whose rules are not checked yet, with the inputs that only other choices
/// (of a drive) use. Units and what a scene needs are checked for every combination of the choices.
/// @param entries  of the file's "scene" and "set"
/// @param place    named in messages
/// @throws std::invalid_argument naming what is missing or wrong
RollingScene base_scene(const std::vector<SceneEntry>& entries, const std::vector<GivenAxis>& axes,
                        const std::string& place);

}  // namespace rollres
