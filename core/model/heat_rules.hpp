#pragma once

/// The rules that a scene must keep so that the heat of rolling can be told.

#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace rollres {

/// Every rule of heat that the scene breaks, each as one line "key = value: rule"; none where heat is off.
/// @param in_range  whether all inputs are in their ranges, so that laws of shift can be asked
std::vector<std::string> broken_heat_rules(const RollingScene& scene, bool in_range);

}  // namespace rollres
