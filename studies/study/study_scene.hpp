#pragma once

/// The scene of a file that varies one: its "scene" and "set". For sources only: it needs nlohmann_json.

#include <filesystem>
#include <string>
#include <vector>

#include "studies/scene_io/scene_entries.hpp"

namespace rollres {

/// The entries of "scene": the name of a scene file, relative to `file`, or the scene itself.
/// @throws std::invalid_argument naming place, key, value and rule
/// @throws std::runtime_error if the scene file cannot be read
std::vector<SceneEntry> scene_entries_of(const Json& object, const std::filesystem::path& file,
                                         const std::string& place);

/// The entries of "set", inputs that replace others; none if there is no such key.
std::vector<SceneEntry> set_entries(const Json& object, const std::string& place);

}  // namespace rollres
