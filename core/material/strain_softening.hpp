#pragma once

/// Moduli that depend on the amplitude of the strain (Payne's effect), and the linear material that stands for them at
/// one amplitude and frequency.
///
/// Kraus (1984), for the amplitude gamma of shear, with r = (gamma/gamma_c)^(2 m):
///     G'/G'lin = 1 - drop r/(1 + r),    G"/G"lin = 1 + 2 (peak - 1) sqrt(r)/(1 + r);
/// a strain sweep is interpolated, ln G over ln gamma, its first row counting as small strains; beyond its rows it
/// stays as at the nearest one. Equivalent linearisation: with G* = G0 + R(omega), R of the relaxation spectrum, the
/// material
///     a G0 + b R(omega),   b = h,   a = (s (G0 + R') - h R')/G0,   s = G'/G'lin, h = G"/G"lin,
/// has the wanted G' and G" at omega and is causal and passive for a, b > 0, as a spectrum of positive moduli.

#include <optional>
#include <string>

#include "core/material/material.hpp"

namespace rollres {

/// G'/G'lin and G"/G"lin at an amplitude [1].
struct Softening {
  double storage = 1, loss = 1;
};

/// Whether the layer's moduli depend on the strain.
bool softens(const MaterialInputs& layer);

/// @param amplitude of the shear strain [1], >= 0; half of peak to peak
Softening softening_at(const MaterialInputs& layer, double amplitude);

/// The layer's largest measured amplitude as shear strain [1]; nothing without a sweep.
std::optional<double> largest_measured_strain(const MaterialInputs& layer);

/// The factors a and b that give a linear spectrum this softening at a frequency [rad/s]; nothing where a or b would
/// not be positive.
std::optional<SofteningFactors> softening_factors(const CreepSpectrum& linear, const Softening& wanted, double omega);

/// The spectrum with its modulus at rest and its relaxation spectrum times the factors.
CreepSpectrum softened(const CreepSpectrum& linear, const SofteningFactors& factors);

}  // namespace rollres
