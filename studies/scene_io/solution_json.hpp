#pragma once

/// Scenes and solutions as JSON text, under the keys of their lists.

#include <string>

#include "core/scene/scene.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

/// A scene file that reads back as the same scene: numbers in SI (as texts with the unit where bare ones are
/// refused, doubtful_number.hpp), "infinite" for infinity, absent inputs left out.
std::string scene_json(const RollingScene& scene);

/// One object: every output under its key (null where it is absent, a list for warnings), and the inputs under "scene".
std::string solution_json(const RollingScene& scene, const RollingSolution& solution);

/// The outputs alone on one line. @param id as JSON, the first member
std::string solution_line(const RollingSolution& solution, const std::string& id);

}  // namespace rollres
