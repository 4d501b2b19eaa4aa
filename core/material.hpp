#pragma once

/// Linear viscoelastic material of the layer.

#include <complex>
#include <vector>

#include "core/scene.hpp"

namespace rollres {

/// Creep compliance in shear as a discrete spectrum: J(t) = instantaneous + sum_m compliance_m (1 - e^{-t/time_m}),
/// so that 1/G*(omega) = instantaneous + sum_m compliance_m / (1 + i omega time_m).
struct CreepSpectrum {
  struct Term {
    double compliance;  // [1/Pa]
    double time;        // retardation time [s]
  };
  double instantaneous = 0;  // 1 / G'(infinity) [1/Pa]
  std::vector<Term> terms;

  /// 1/G*(omega) [1/Pa], omega [rad/s] of either sign.
  std::complex<double> operator()(double omega) const;
};

/// The scene's material. Zener solid: G* = G0 (1+f)(1 + i omega tau) / ((1+f) + i omega tau), hence
/// 1/G* = [1 + f / (1 + i omega tau)] / (G0 (1+f)) (Zehil and Gavin 2013, eq. 41).
CreepSpectrum creep_spectrum(const RollingScene& scene);

/// G*(omega) of the scene's material [Pa].
std::complex<double> complex_modulus(const RollingScene& scene, double omega);

}  // namespace rollres
