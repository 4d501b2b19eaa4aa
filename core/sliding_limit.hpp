#pragma once

/// What friction can give at most: the whole contact sliding one way.

#include "core/scene.hpp"
#include "core/solution.hpp"

namespace rollres {

/// Whether sliding gives the traction that the scene's drive asks for.
enum class SlidingLimit { enough, not_enough, unknown };
SlidingLimit sliding_limit(const RollingScene& scene, const SurfaceGrid& half_grid);

/// Friction coefficient at which sliding just gives the traction that the scene's drive asks for, on a given grid (the
/// scene's own if it suffices). NaN if that could not be found out.
double friction_needed(const RollingScene& scene, const SurfaceGrid& half_grid);

}  // namespace rollres
