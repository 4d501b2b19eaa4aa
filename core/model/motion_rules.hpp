#pragma once

/// The rules of a body's shape and of an axle or a path that is turned.

#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace rollres {

/// Every one that the scene breaks, each as one line "key = value: rule".
std::vector<std::string> broken_motion_rules(const RollingScene& scene);

}  // namespace rollres
