#pragma once

/// What turns the numbers of a layer's material into moduli of shear and times at its temperature.
///
/// Time-temperature superposition: at temperature T a material is, at frequency omega, what it is at a(T) omega at the
/// reference temperature.

#include "core/scene/material_inputs.hpp"

namespace rollres {

/// G'(0) [Pa] from static_shear_modulus or static_young_modulus, one of which must be there.
double given_static_modulus(const MaterialInputs& layer);

/// A modulus of one of the layer's lists [Pa] as a modulus of shear.
double as_shear(const MaterialInputs& layer, double listed);

/// a(T): the times of the layer at its temperature over those at the reference; 1 without a temperature.
double time_shift(const MaterialInputs& layer);

enum class ShiftLaw { none, wlf, arrhenius };

/// log10 a = -c1 (T - T0) / (c2 + T - T0) (Williams, Landel and Ferry 1955, J. Am. Chem. Soc. 77, 3701), or
/// ln a = E/R (1/T - 1/T0).
struct TemperatureShift {
  ShiftLaw law = ShiftLaw::none;
  double reference = 293.15;     ///< T0 [K]
  double c1 = 0, c2 = 0;         ///< [1], [K], of WLF
  double activation_energy = 0;  ///< E [J/mol], of Arrhenius
};

/// a(T). @param temperature [K]; for WLF above T0 - c2
/// @throws std::invalid_argument if it is not
double shift_factor(const TemperatureShift& shift, double temperature);

}  // namespace rollres
