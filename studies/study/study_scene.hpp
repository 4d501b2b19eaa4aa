#pragma once

/// The scene of a file that varies one. For sources only: it needs nlohmann_json.

#include <filesystem>
#include <string>
#include <vector>

#include "studies/scene_io/scene_entries.hpp"
#include "studies/study/study_axes.hpp"

namespace rollres {

/// The scene that a file varies, with the lists of a master curve in place of their file's name.
struct CompleteScene {
  Json inputs;
  std::string place;         ///< for messages
  bool stood_alone = false;  ///< in the file itself, and needed no other
};

/// What stands under "scene": the name of a scene file, relative to `file`, or the scene itself.
/// @throws std::invalid_argument naming place, key, value and rule
/// @throws std::runtime_error if the scene file cannot be read
CompleteScene complete_scene(const Json& object, const std::filesystem::path& file, const std::string& place);

/// Its entries, checked one by one.
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

/// Text of a study file that needs no other file: the scene stands in it, in full. `text`, which is that of `study`, is
/// left as it is if it does already.
/// @param file  that names of files are relative to
std::string standalone_text(Json study, const std::string& text, const CompleteScene& scene,
                            const std::filesystem::path& file);

/// The same of a file that is not read otherwise. @throws as read_study, of which this is no check
std::string standalone_study(const std::filesystem::path& file);

}  // namespace rollres
