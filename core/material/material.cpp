#include "core/material/material.hpp"

#include <algorithm>
#include <utility>

#include "core/material/fractional_zener.hpp"
#include "core/material/master_curve.hpp"
#include "core/material/material_scale.hpp"
#include "core/material/passivity.hpp"
#include "core/material/prony_series.hpp"
#include "core/material/strain_softening.hpp"
#include "core/messages/message_text.hpp"

namespace rollres {

namespace {

bool change(const SofteningFactors& factors) { return factors.rest != 1 || factors.relaxation != 1; }

CreepSpectrum creep_of(PronySeries series, const SofteningFactors& factors) {
  if (change(factors)) {
    series.static_modulus *= factors.rest;
    for (PronySeries::Term& term : series.terms) term.modulus *= factors.relaxation;
  }
  return creep_spectrum(series);
}

CreepSpectrum creep_of(const FractionalZener& solid, const SofteningFactors& factors) {
  const CreepSpectrum linear = creep_spectrum(solid);
  return change(factors) ? softened(linear, factors) : linear;
}

PronySeries prony_series(const MaterialInputs& layer) {
  PronySeries series{given_static_modulus(layer), {}};
  for (std::size_t j = 0; j < layer.relaxation_times.size(); ++j)
    series.terms.push_back({as_shear(layer, layer.relaxation_moduli[j]), layer.relaxation_times[j]});
  return ordered(std::move(series));
}

/// "table of 13 a_T, between its rows by hyperbolas"
std::string table_in_words(const MaterialInputs& layer, const std::string& symbol) {
  return message_text("table of ", layer.shift_temperatures.size(), " ", symbol, ", between its rows by hyperbolas");
}

/// What shifts the times, in words; empty if nothing.
std::string shift_law(const MaterialInputs& layer) {
  if (!layer.shift_factors.empty()) return table_in_words(layer, "a_T");
  return layer.wlf_c1 ? "WLF" : layer.vft_b ? "VFT" : layer.activation_energy ? "Arrhenius" : "";
}

CreepSpectrum spectrum_at_reference(const MaterialInputs& layer, const SofteningFactors& factors) {
  switch (layer.material) {
    case MaterialModel::zener:
      return creep_of(FractionalZener{given_static_modulus(layer), layer.stiffening, layer.creep_time}, factors);
    case MaterialModel::fractional_zener:
      return creep_of(
          FractionalZener{given_static_modulus(layer), layer.stiffening, layer.creep_time, layer.fractional_order},
          factors);
    case MaterialModel::prony:
      return creep_of(prony_series(layer), factors);
    case MaterialModel::master_curve:
    case MaterialModel::relaxation_curve:
      return creep_of(shared_master_curve_fit(layer)->series, factors);
    case MaterialModel::elastic:
      break;
  }
  return {.instantaneous = 1 / (factors.rest * given_static_modulus(layer)), .terms = {}};
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

CreepSpectrum creep_spectrum(const MaterialInputs& layer, const SofteningFactors& factors) {
  CreepSpectrum spectrum = spectrum_at_reference(layer, factors);
  if (const double shift = time_shift(layer); shift != 1)
    for (CreepSpectrum::Term& term : spectrum.terms) term.time *= shift;
  if (const double shift = modulus_shift(layer); shift != 1) {
    spectrum.instantaneous *= shift;
    for (CreepSpectrum::Term& term : spectrum.terms) term.compliance *= shift;
  }
  return spectrum;
}

std::complex<double> complex_modulus(const MaterialInputs& layer, double omega) {
  return 1.0 / creep_spectrum(layer)(omega);
}

double static_modulus(const MaterialInputs& layer, const SofteningFactors& factors) {
  const bool given = layer.static_shear_modulus || layer.static_young_modulus;
  return given ? factors.rest * given_static_modulus(layer) / modulus_shift(layer)
               : 1 / creep_spectrum(layer, factors).at_rest();
}

std::string material_route(const MaterialInputs& layer) {
  std::string route;
  if (layer.material == MaterialModel::prony)
    route = message_text<5>("Prony series of ", prony_series(layer).terms.size(), " terms, exact");
  if (is_measured_curve(layer.material)) route = shared_master_curve_fit(layer)->in_words();
  if (layer.material == MaterialModel::fractional_zener)
    route = layer.fractional_order == 1
                ? "fractional Zener solid of order 1: a Zener solid"
                : message_text<5>("fractional Zener solid as ", creep_spectrum(layer).terms.size(),
                                  " exponentials, 1/G* to 1e-7");
  const auto add = [&](const char* what, double shift, const std::string& law) {
    route += message_text<5>(route.empty() ? "" : "; ", what, " at ", in_celsius(*layer.temperature), ": ", shift,
                             " of those at ", in_celsius(*layer.reference_temperature), " (", law, ")");
  };
  if (layer.temperature && layer.material != MaterialModel::elastic && !shift_law(layer).empty())
    add("times", time_shift(layer), shift_law(layer));
  if (layer.temperature && !layer.modulus_shifts.empty())
    add("moduli", 1 / modulus_shift(layer), table_in_words(layer, "b_T"));
  return route;
}

std::vector<std::string> material_warnings(const MaterialInputs& layer) {
  std::vector<std::string> warnings;
  if (is_measured_curve(layer.material)) warnings = shared_master_curve_fit(layer)->remarks;
  if (const std::string swapped = swapped_moduli(layer.sweep_storage_moduli, layer.sweep_loss_moduli); !swapped.empty())
    warnings.push_back("strain sweep: " + swapped);
  if (layer.temperature && layer.wlf_c1) {
    const double above = *layer.temperature - *layer.reference_temperature;
    if (above < -0.8 * *layer.wlf_c2)
      warnings.push_back(message_text<5>("temperature = ", in_celsius(*layer.temperature),
                                         ": is close to where WLF has no meaning (",
                                         in_celsius(*layer.reference_temperature - *layer.wlf_c2), ")"));
  }
  if (layer.temperature && !layer.shift_factors.empty()) {
    const auto& rows = layer.shift_temperatures;
    const auto factor = [&](auto row) { return layer.shift_factors[static_cast<std::size_t>(row - rows.begin())]; };
    const auto [coldest, warmest] = std::minmax_element(rows.begin(), rows.end());
    if (factor(coldest) < factor(warmest))
      warnings.push_back(message_text<5>("shift_factors: a_T rises with temperature, from ", factor(coldest), " at ",
                                         in_celsius(*coldest), " to ", factor(warmest), " at ", in_celsius(*warmest),
                                         ", where times of materials fall: is 1/a_T meant?"));
  }
  if (layer.temperature && layer.vft_b) {
    const double far = *layer.reference_temperature - *layer.vft_temperature;
    if (*layer.temperature < *layer.vft_temperature + 0.2 * far)
      warnings.push_back(message_text<5>("temperature = ", in_celsius(*layer.temperature),
                                         ": is close to where VFT has no meaning (", in_celsius(*layer.vft_temperature),
                                         ")"));
  }
  return warnings;
}

}  // namespace rollres
