#pragma once

/// A scene with its solution as text for people, and what was decided on the way to it.

#include <string>

#include "core/scene/scene.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

/// A scene and its solution for people: status, reason and warnings first, then inputs and outputs with units, aligned.
/// Absent numbers are left out, and what further layers have by default.
std::string summary(const RollingScene& scene, const RollingSolution& solution);

/// What was decided, left out and kept, one to a line, and the estimated error: the words of `model`.
std::string explanation(const RollingScene& scene, const RollingSolution& solution);

}  // namespace rollres
