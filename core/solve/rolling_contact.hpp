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

/// A metre of a cylinder whose width is given, under its load per metre; another scene as it is.
RollingScene scene_per_metre(RollingScene scene);
/// From the answer to that the one to the scene, to the last bit as `solve` gives it but for the seconds.
RollingSolution answer_of_width(const RollingScene& scene, RollingSolution per_metre);

/// The waist of the program: studies, fits and optimisers take any function of this shape.
using Evaluate = std::function<RollingSolution(const RollingScene&)>;

}  // namespace rollres
