#pragma once

/// The scene of a file that varies one. For sources only: it needs nlohmann_json.

#include <filesystem>
#include <string>
#include <vector>

#include "studies/scene_io/scene_entries.hpp"
#include "studies/study/study_axes.hpp"

namespace rollres {

/// The entries of "scene": the name of a scene file, relative to `file`, or the scene itself.
/// @throws std::invalid_argument naming place, key, value and rule
/// @throws std::runtime_error if the scene file cannot be read
std::vector<SceneEntry> scene_entries_of(const Json& object, const std::filesystem::path& file,
                                         const std::string& place);

/// The entries of "set", inputs that replace others; none if there is no such key.
std::vector<SceneEntry> set_entries(const Json& object, const std::string& place);

/// The scene at the first values of the axes, whose rules are not checked yet, with the inputs that only other choices
/// (of a drive) use. Units and what a scene needs are checked for every combination of the choices.
/// @param entries  of the file's "scene" and "set"
/// @param place    named in messages
/// @throws std::invalid_argument naming what is missing or wrong
RollingScene base_scene(const std::vector<SceneEntry>& entries, const std::vector<GivenAxis>& axes,
                        const std::string& place);

/// Text of a study file that needs no other file: the scene stands in it in place of the name of its file, and a
/// master curve's lists in place of the name of theirs. The text is
/// left as it is if it does already.
/// @throws std::invalid_argument, std::runtime_error as read_study, of which this is no check
std::string standalone_study(const std::filesystem::path& file);

}  // namespace rollres
