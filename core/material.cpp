#include "core/material.hpp"

#include <algorithm>

#include "core/temperature_shift.hpp"

namespace rollres {

namespace {

double modulus_at_rest(const MaterialInputs& layer) {
  if (layer.static_shear_modulus) return *layer.static_shear_modulus;
  return *layer.static_young_modulus / (2 * (1 + layer.poisson_ratio));
}

CreepSpectrum zener_spectrum(double modulus, double stiffening, double creep_time) {
  if (stiffening == 0 || creep_time == 0) return {.instantaneous = 1 / modulus, .terms = {}};
  const double glassy = 1 / (modulus * (1 + stiffening));
  return {.instantaneous = glassy, .terms = {{stiffening * glassy, creep_time}}};
}

CreepSpectrum spectrum_at_reference(const MaterialInputs& layer) {
  return zener_spectrum(modulus_at_rest(layer), layer.stiffening, layer.creep_time);
}

}  // namespace

std::complex<double> CreepSpectrum::operator()(double omega) const {
  std::complex<double> sum = instantaneous;
  for (const Term& term : terms) sum += term.compliance / std::complex<double>(1, omega * term.time);
  return sum;
}

double CreepSpectrum::at_rest() const {
  double sum = instantaneous;
  for (const Term& term : terms) sum += term.compliance;
  return sum;
}

CreepSpectrum creep_spectrum(const MaterialInputs& layer) {
  if (layer.material == MaterialModel::elastic) return {.instantaneous = 1 / modulus_at_rest(layer), .terms = {}};
  CreepSpectrum spectrum = spectrum_at_reference(layer);
  return spectrum;
}

std::complex<double> complex_modulus(const MaterialInputs& layer, double omega) {
  return 1.0 / creep_spectrum(layer)(omega);
}

double static_modulus(const MaterialInputs& layer) {
  return needs_static_modulus(layer.material) ? modulus_at_rest(layer) : 1 / creep_spectrum(layer).at_rest();
}

std::string material_route(const MaterialInputs&) { return {}; }

std::vector<std::string> material_warnings(const MaterialInputs&) { return {}; }

}  // namespace rollres
