#pragma once

/// The rules of a body's shape and of an axle or a path that is turned.

#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace rollres {

/// Every one that the scene breaks, each as one line "key = value: rule".
std::vector<std::string> broken_motion_rules(const RollingScene& scene);

/// Whether the contact is its own mirror image in y: of a cylinder, of a ball without friction whatever turns it, else
/// of straight motion and an outline that is its own mirror image.
bool has_mirror(const RollingScene& scene);

/// The first rule that a roller's profile breaks, as such a line; empty: none.
std::string profile_fault(const RollingScene& scene);

}  // namespace rollres
