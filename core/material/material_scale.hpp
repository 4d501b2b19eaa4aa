#pragma once

/// What turns the numbers of a layer's material into moduli of shear and times at its temperature.

#include "core/scene/material_inputs.hpp"

namespace rollres {

/// G'(0) [Pa] from static_shear_modulus or static_young_modulus, one of which must be there.
double given_static_modulus(const MaterialInputs& layer);

/// A modulus of one of the layer's lists [Pa] as a modulus of shear.
double as_shear(const MaterialInputs& layer, double listed);

/// a(T): the times of the layer at its temperature over those at the reference; 1 without a temperature.
double time_shift(const MaterialInputs& layer);

}  // namespace rollres
