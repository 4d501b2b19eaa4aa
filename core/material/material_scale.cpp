#include "core/material/material_scale.hpp"

#include "core/material/temperature_shift.hpp"

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

}  // namespace rollres
