#pragma once

/// Time-temperature superposition: at temperature T a material is, at frequency omega, what it is at a(T) omega at the
/// reference temperature.

namespace rollres {

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
