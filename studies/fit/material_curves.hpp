#pragma once

/// The fitted curves between the measured values of fits of materials.

#include "studies/fit/fit_curves.hpp"
#include "studies/fit/material_file.hpp"
#include "studies/fit/shift_file.hpp"
#include "studies/fit/strain_file.hpp"

namespace rollres {

/// The curves of the moduli at the reference temperature, with their 95 % bands; data are shifted there.
FitCurves modulus_curves(const MaterialFile& file, const MaterialFit& found);

/// ln a against the temperature.
FitCurves shift_curves(const ShiftFile& file, const TemperatureShift& shift);

/// Storage and loss moduli against the amplitude of the shear strain, with their 95 % bands.
FitCurves strain_curves(const StrainFile& file, const StrainFit& found);

}  // namespace rollres
