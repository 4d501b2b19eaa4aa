#include "core/material/strain_softening.hpp"

#include <algorithm>
#include <cmath>

#include "core/material/prony_series.hpp"

namespace rollres {

namespace {

/// Shear strain amplitude per listed strain of the sweep.
double shear_per_strain(const MaterialInputs& layer) {
  const double peak = layer.sweep_amplitude == SweepAmplitude::peak_to_peak ? 0.5 : 1;
  const double shear =
      layer.sweep_deformation == SweepDeformation::tension ? 2 * (1 + layer.poisson_ratio) / std::sqrt(3.0) : 1;
  return peak * shear;
}

Softening interpolated(const MaterialInputs& layer, double listed_strain) {
  const std::vector<double>& strains = layer.sweep_strains;
  const auto relative = [&](std::size_t row) {
    return Softening{layer.sweep_storage_moduli[row] / layer.sweep_storage_moduli.front(),
                     layer.sweep_loss_moduli[row] / layer.sweep_loss_moduli.front()};
  };
  if (listed_strain <= strains.front()) return {};
  if (listed_strain >= strains.back()) return relative(strains.size() - 1);
  const auto above =
      static_cast<std::size_t>(std::upper_bound(strains.begin(), strains.end(), listed_strain) - strains.begin());
  const double place = std::log(listed_strain / strains[above - 1]) / std::log(strains[above] / strains[above - 1]);
  const Softening low = relative(above - 1), high = relative(above);
  return {low.storage * std::pow(high.storage / low.storage, place), low.loss * std::pow(high.loss / low.loss, place)};
}

}  // namespace

bool softens(const MaterialInputs& layer) {
  return layer.payne_drop > 0 || layer.payne_loss_peak != 1 || !layer.sweep_strains.empty();
}

Softening softening_at(const MaterialInputs& layer, double amplitude) {
  if (!softens(layer) || !(amplitude > 0)) return {};
  if (!layer.sweep_strains.empty()) return interpolated(layer, amplitude / shear_per_strain(layer));
  const double root = std::pow(amplitude / *layer.payne_strain, layer.payne_exponent);  // sqrt(r)
  const double share = 1 / (1 + 1 / (root * root));
  return {1 - layer.payne_drop * share, 1 + 2 * (layer.payne_loss_peak - 1) / (root + 1 / root)};
}

std::optional<double> largest_measured_strain(const MaterialInputs& layer) {
  if (layer.sweep_strains.empty()) return std::nullopt;
  return layer.sweep_strains.back() * shear_per_strain(layer);
}

std::optional<SofteningFactors> softening_factors(const CreepSpectrum& linear, const Softening& wanted, double omega) {
  const double at_rest = 1 / linear.at_rest(), relaxed = (1.0 / linear(omega)).real() - at_rest;
  const SofteningFactors factors{wanted.storage + (wanted.storage - wanted.loss) * relaxed / at_rest, wanted.loss};
  if (!(factors.rest > 0 && factors.relaxation > 0)) return std::nullopt;
  return factors;
}

CreepSpectrum softened(const CreepSpectrum& linear, const SofteningFactors& factors) {
  const double at_rest = factors.rest / linear.at_rest();
  PronySeries series{at_rest, {}};
  CreepSpectrum creeping = linear;
  std::erase_if(creeping.terms, [](const CreepSpectrum::Term& term) { return !(term.compliance > 0); });
  for (const RelaxationSpectrum::Term& term : relaxation_spectrum(creeping).terms)
    series.terms.push_back({factors.relaxation * term.modulus, term.time});
  return creep_spectrum(ordered(std::move(series)));
}

}  // namespace rollres
