#include "core/material/material_scale.hpp"

#include <cmath>

#include "core/messages/require.hpp"

namespace rollres {

double given_static_modulus(const MaterialInputs& layer) {
  if (layer.static_shear_modulus) return *layer.static_shear_modulus;
  return *layer.static_young_modulus / (2 * (1 + layer.poisson_ratio));
}

double as_shear(const MaterialInputs& layer, double listed) {
  return layer.listed_moduli == ListedModuli::young ? listed / (2 * (1 + layer.poisson_ratio)) : listed;
}

double time_shift(const MaterialInputs& layer) {
  if (!layer.temperature) return 1;
  TemperatureShift shift{.law = ShiftLaw::arrhenius, .reference = *layer.reference_temperature};
  if (layer.wlf_c1) {
    shift.law = ShiftLaw::wlf;
    shift.c1 = *layer.wlf_c1;
    shift.c2 = *layer.wlf_c2;
  } else {
    shift.activation_energy = *layer.activation_energy;
  }
  return shift_factor(shift, *layer.temperature);
}

double shift_factor(const TemperatureShift& shift, double temperature) {
  constexpr double gas_constant = 8.31446261815324;  // [J/(mol K)]
  require_positive("temperature", temperature);
  const double above = temperature - shift.reference;
  if (shift.law == ShiftLaw::arrhenius)
    return std::exp(shift.activation_energy / gas_constant * (1 / temperature - 1 / shift.reference));
  if (shift.law == ShiftLaw::none) return 1;
  require(shift.c2 + above > 0, "temperature", temperature, "must be above the reference less c2 for WLF");
  return std::pow(10, -shift.c1 * above / (shift.c2 + above));
}

}  // namespace rollres
