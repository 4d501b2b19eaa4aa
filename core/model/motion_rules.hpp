#pragma once

/// The rules of a body's shape and of an axle or a path that is turned.

#include <optional>
#include <string>
#include <vector>

#include "core/model/roller_outline.hpp"
#include "core/scene/scene.hpp"

namespace rollres {

/// Every one that the scene breaks, each as one line "key = value: rule".
std::vector<std::string> broken_motion_rules(const RollingScene& scene);

/// The first rule that a roller's profile breaks, as such a line; empty: none.
std::string profile_fault(const RollingScene& scene);

/// The outline of a roller; none of another body, or where its inputs break these rules.
std::optional<RollerOutline> outline_of(const RollingScene& scene);

}  // namespace rollres
