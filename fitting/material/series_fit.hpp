#pragma once

/// Prony series fitted to moduli, of even times or of free ones.

#include <vector>

#include "fitting/material/material_fit.hpp"

namespace rollres {

/// The shift, among those of its law, at which the Prony series of least squares has the least misfit; without a law,
/// or where no series tells, that of the options.
TemperatureShift best_shift(const std::vector<MeasuredModulus>& data, const MaterialFitOptions& options);

/// @throws as fit_material
MaterialFit fit_series(const std::vector<MeasuredModulus>& data, const MaterialFitOptions& options);

}  // namespace rollres
