#pragma once

/// Steady-state frictional rolling contact: the way in.

#include <functional>

#include "core/scene/scene.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

/// Solves one scene.
/// @throws std::invalid_argument naming key, value and rule if the scene breaks one (see `check`)
/// Everything else is in the solution: `status`, `reason`, `warnings`.
RollingSolution solve(const RollingScene& scene);

/// The waist of the program: studies, fits and optimisers take any function of this shape.
using Evaluate = std::function<RollingSolution(const RollingScene&)>;

}  // namespace rollres
