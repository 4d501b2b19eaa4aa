#pragma once

/// Influence coefficients of whatever is more than one layer of one material without inertia (contact_surface.hpp), by
/// the body's own way: line_passage.hpp, sphere_passage.hpp.

#include "core/influence/influence.hpp"
#include "core/scene/scene.hpp"

namespace rollres {

/// Influence coefficients of a composite surface for a single passage.
InfluenceTable composite_table(const RollingScene& scene, const SurfaceGrid& grid, int reach_x, int reach_y);

/// Largest relative error of the expansion in retardation times that such coefficients contain (medium_expansion.hpp).
double expansion_error(const RollingScene& scene);

}  // namespace rollres
