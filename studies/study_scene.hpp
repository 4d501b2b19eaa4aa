#pragma once

/// Reads the scene of a study: "scene" and "set" of its file. For sources only: it needs nlohmann_json.

#include <filesystem>
#include <string>
#include <vector>

#include "studies/study_axes.hpp"

namespace rollres {

/// The inputs of "scene", a file beside `file` or an object, with those of "set" in their place.
/// @param place   the file in messages
/// @param varied  keys that "set" must not give
/// @throws std::invalid_argument naming place, key, value and rule
/// @throws std::runtime_error if the scene file cannot be read
std::vector<SceneEntry> study_entries(const Json& study, const std::filesystem::path& file, const std::string& place,
                                      const std::vector<GivenAxis>& varied);

/// The scene at the first values of the axes, whose rules are not checked yet, with the inputs that only other choices
/// (of a drive) use. Units and what a scene needs are checked for every combination of the choices.
/// @throws std::invalid_argument naming what is missing or wrong
RollingScene base_scene(const std::vector<SceneEntry>& entries, const std::vector<GivenAxis>& axes,
                        const std::string& place);

}  // namespace rollres
