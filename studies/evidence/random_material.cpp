#include "studies/evidence/random_material.hpp"

#include <algorithm>
#include <numeric>

#include "core/material/material.hpp"
#include "core/material/material_scale.hpp"
#include "core/material/prony_series.hpp"

namespace rollres {

namespace {

/// The shortest of times over so many decades among which the contact's is [s].
double shortest_time(Dice& dice, double contact_time, double decades) {
  return contact_time * std::pow(10.0, -decades * dice.uniform(0, 1));
}

void draw_prony(Dice& dice, double contact_time, MaterialInputs& layer) {
  layer.material = MaterialModel::prony;
  layer.stiffening = layer.creep_time = 0;
  const int terms = 5 + dice.choice(36);
  const double decades = dice.uniform(2, 16), shortest = shortest_time(dice, contact_time, decades);
  for (int i = 0; i < terms; ++i)
    layer.relaxation_times.push_back(dice.log_uniform(shortest, shortest * std::pow(10.0, decades)));
  std::sort(layer.relaxation_times.begin(), layer.relaxation_times.end());
  const double slope = dice.uniform(0, 0.4);
  for (const double time : layer.relaxation_times)
    layer.relaxation_moduli.push_back(std::pow(time / shortest, -slope) * dice.log_uniform(0.3, 3));
  const double drawn = std::accumulate(layer.relaxation_moduli.begin(), layer.relaxation_moduli.end(), 0.0);
  const double wanted = *layer.static_shear_modulus * dice.log_uniform(0.1, 1000);
  for (double& modulus : layer.relaxation_moduli) modulus = rounded(modulus * wanted / drawn);
}

void draw_fractional(Dice& dice, double contact_time, MaterialInputs& layer) {
  layer.material = MaterialModel::fractional_zener;
  layer.stiffening = dice.log_uniform(1, 1000);
  layer.fractional_order = rounded(dice.uniform(0.1, 1));
  layer.creep_time = rounded(contact_time * dice.log_uniform(1e-4, 1e4));
}

/// Of a fractional Zener solid, measured to four digits.
void draw_master_curve(Dice& dice, double contact_time, MaterialInputs& layer) {
  draw_fractional(dice, contact_time, layer);
  layer.fractional_order = rounded(dice.uniform(0.15, 0.6));
  const CreepSpectrum creep = creep_spectrum(layer);
  const int rows = 15 + dice.choice(36);
  const double decades = dice.uniform(6, 12), slowest = shortest_time(dice, 1 / contact_time, decades);
  for (int i = 0; i < rows; ++i) {
    const double frequency = slowest * std::pow(10.0, decades * i / (rows - 1));  // [rad/s]
    const std::complex<double> modulus = 1.0 / creep(frequency);
    layer.frequencies.push_back(rounded(frequency / 6.283));
    layer.storage_moduli.push_back(rounded(modulus.real()));
    layer.loss_moduli.push_back(rounded(modulus.imag()));
  }
  layer.material = MaterialModel::master_curve;
  layer.static_shear_modulus.reset();
  layer.stiffening = layer.creep_time = 0;
  layer.fractional_order = 1;
}

/// Of a Prony solid, measured to four digits.
void draw_relaxation_curve(Dice& dice, double contact_time, MaterialInputs& layer) {
  draw_prony(dice, contact_time, layer);
  PronySeries series{*layer.static_shear_modulus, {}};
  for (std::size_t i = 0; i < layer.relaxation_times.size(); ++i)
    series.terms.push_back({layer.relaxation_moduli[i], layer.relaxation_times[i]});
  layer.relaxation_times.clear();
  layer.relaxation_moduli.clear();
  const int rows = 15 + dice.choice(36);
  const double decades = dice.uniform(6, 12), shortest = shortest_time(dice, contact_time, decades);
  for (int i = 0; i < rows; ++i) {
    layer.relaxation_times.push_back(rounded(shortest * std::pow(10.0, decades * i / (rows - 1))));
    layer.relaxation_moduli.push_back(rounded(relaxation_modulus(series, layer.relaxation_times.back())));
  }
  layer.material = MaterialModel::relaxation_curve;
  layer.static_shear_modulus.reset();
}

/// A temperature at which the times are what they were without.
void draw_temperature(Dice& dice, MaterialInputs& layer) {
  layer.reference_temperature = 293;
  layer.temperature = rounded(dice.uniform(283, 313));
  if (dice.choice(2) == 0) {
    layer.wlf_c1 = 17.44;
    layer.wlf_c2 = 51.6;
  } else {
    layer.activation_energy = dice.log_uniform(4e4, 2e5);
  }
  const double shift = time_shift(layer);
  layer.creep_time = rounded(layer.creep_time / shift);
  for (double& time : layer.relaxation_times) time = rounded(time / shift);
  for (double& frequency : layer.frequencies) frequency = rounded(frequency * shift);
}

}  // namespace

void draw_material(Dice& dice, double contact_time, MaterialInputs& layer) {
  switch (dice.choice(8)) {
    case 0:
      layer.material = MaterialModel::elastic;
      layer.stiffening = layer.creep_time = 0;
      return;
    case 1:
      if (dice.choice(3) == 0)
        draw_relaxation_curve(dice, contact_time, layer);
      else
        draw_master_curve(dice, contact_time, layer);
      break;
    case 2:
    case 3:
      draw_fractional(dice, contact_time, layer);
      break;
    default:
      draw_prony(dice, contact_time, layer);
      break;
  }
  if (dice.choice(4) == 0) draw_temperature(dice, layer);
}

}  // namespace rollres
