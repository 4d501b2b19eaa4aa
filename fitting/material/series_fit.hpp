#pragma once

/// Prony series fitted to moduli, of even times or of free ones.

#include <vector>

#include "fitting/material/material_fit.hpp"

namespace rollres {

/// @throws as fit_material
MaterialFit fit_series(const std::vector<MeasuredModulus>& data, const MaterialFitOptions& options);

}  // namespace rollres
