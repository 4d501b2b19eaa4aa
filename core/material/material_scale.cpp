#include "core/material/material_scale.hpp"

#include <algorithm>
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

namespace {

TemperatureShift shift_of(const MaterialInputs& layer) {
  TemperatureShift shift{.law = ShiftLaw::none,
                         .reference = *layer.reference_temperature,
                         .table = {layer.shift_temperatures, layer.shift_factors, layer.modulus_shifts}};
  if (!layer.shift_factors.empty()) {
    shift.law = ShiftLaw::table;
  } else if (layer.wlf_c1) {
    shift.law = ShiftLaw::wlf;
    shift.c1 = *layer.wlf_c1;
    shift.c2 = *layer.wlf_c2;
  } else if (layer.vft_b) {
    shift.law = ShiftLaw::vft;
    shift.vft_b = *layer.vft_b;
    shift.vft_temperature = *layer.vft_temperature;
  } else if (layer.activation_energy) {
    shift.law = ShiftLaw::arrhenius;
    shift.activation_energy = *layer.activation_energy;
  }
  return shift;
}

/// What one list of a table says of a temperature over what it says of the reference.
double table_ratio(const TemperatureShift& shift, const std::vector<double>& factors, double temperature) {
  const TableFactors at(shift.table.temperatures, factors);
  return at(temperature) / at(shift.reference);
}

}  // namespace

double time_shift(const MaterialInputs& layer) {
  return layer.temperature ? shift_factor(shift_of(layer), *layer.temperature) : 1;
}

double modulus_shift(const MaterialInputs& layer) {
  return layer.temperature ? modulus_factor(shift_of(layer), *layer.temperature) : 1;
}

double modulus_factor(const TemperatureShift& shift, double temperature) {
  return shift.table.moduli.empty() ? 1 : table_ratio(shift, shift.table.moduli, temperature);
}

double shift_factor(const TemperatureShift& shift, double temperature) {
  constexpr double gas_constant = 8.31446261815324;  // [J/(mol K)]
  require_positive("temperature", temperature);
  const double above = temperature - shift.reference;
  if (shift.law == ShiftLaw::arrhenius)
    return std::exp(shift.activation_energy / gas_constant * (1 / temperature - 1 / shift.reference));
  if (shift.law == ShiftLaw::none) return 1;
  if (shift.law == ShiftLaw::table) return table_ratio(shift, shift.table.factors, temperature);
  if (shift.law == ShiftLaw::vft) {
    const double lowest = shift.vft_temperature;
    require(temperature > lowest && shift.reference > lowest, "temperature", std::min(temperature, shift.reference),
            "must be above T1 of VFT");
    return std::exp(shift.vft_b / (temperature - lowest) - shift.vft_b / (shift.reference - lowest));
  }
  require(shift.c2 + above > 0, "temperature", temperature, "must be above the reference less c2 for WLF");
  return std::pow(10, -shift.c1 * above / (shift.c2 + above));
}

ShiftFactors::ShiftFactors(const TemperatureShift& shift) : shift_(shift) {
  const ShiftTable& table = shift.table;
  if (shift.law == ShiftLaw::table) times_.emplace(table.temperatures, table.factors);
  if (!table.moduli.empty()) moduli_.emplace(table.temperatures, table.moduli);
  if (times_) time_at_reference_ = (*times_)(shift.reference);
  if (moduli_) modulus_at_reference_ = (*moduli_)(shift.reference);
}

double ShiftFactors::time(double temperature) const {
  return times_ ? (*times_)(temperature) / time_at_reference_ : shift_factor(shift_, temperature);
}

double ShiftFactors::modulus(double temperature) const {
  return moduli_ ? (*moduli_)(temperature) / modulus_at_reference_ : 1;
}

}  // namespace rollres
