#pragma once

/// What a scene loses in its layers at many temperatures, cheaply: by Hertz's pressure of the load or the approach
/// (estimate/composite_estimate.hpp), within about a tenth, without friction.

#include <vector>

#include "core/scene/scene.hpp"

namespace rollres {

/// @param scene obeys `check`, of a cylinder   @param temperatures ascending [K]
/// @return the loss at each [W/m], > 0
std::vector<double> estimated_losses(const RollingScene& scene, const std::vector<double>& temperatures);

/// Temperatures from the coldest surroundings up, as near to one another as the shifts ask for: up to the end of a
/// table of shifts, or 400 K above the coldest.
std::vector<double> temperatures_to_scan(const RollingScene& scene);

}  // namespace rollres
