#include "core/material.hpp"

namespace rollres {

std::complex<double> CreepSpectrum::operator()(double omega) const {
  std::complex<double> sum = instantaneous;
  for (const Term& term : terms) sum += term.compliance / std::complex<double>(1, omega * term.time);
  return sum;
}

CreepSpectrum creep_spectrum(const RollingScene& scene) {
  const bool elastic = scene.material == MaterialModel::elastic || scene.stiffening == 0 || scene.creep_time == 0;
  if (elastic) return {.instantaneous = 1 / scene.static_shear_modulus, .terms = {}};
  const double glassy = 1 / (scene.static_shear_modulus * (1 + scene.stiffening));
  return {.instantaneous = glassy, .terms = {{scene.stiffening * glassy, scene.creep_time}}};
}

std::complex<double> complex_modulus(const RollingScene& scene, double omega) {
  return 1.0 / creep_spectrum(scene)(omega);
}

}  // namespace rollres
