#pragma once

/// Linear viscoelastic material of a layer, as the solvers take it: a discrete spectrum of creep.

#include <complex>
#include <string>
#include <vector>

#include "core/scene/material_inputs.hpp"

namespace rollres {

/// Creep compliance in shear as a discrete spectrum: J(t) = instantaneous + sum_m compliance_m (1 - e^{-t/time_m}),
/// so that 1/G*(omega) = instantaneous + sum_m compliance_m / (1 + i omega time_m).
struct CreepSpectrum {
  struct Term {
    double compliance;  // [1/Pa]
    double time;        // retardation time [s]
    bool operator==(const Term&) const = default;
  };
  double instantaneous = 0;  // 1 / G'(infinity) [1/Pa]
  std::vector<Term> terms;   // times ascending, all different

  /// 1/G*(omega) [1/Pa], omega [rad/s] of either sign.
  std::complex<double> operator()(double omega) const;
  /// 1/G'(0) [1/Pa]
  double at_rest() const;

  bool operator==(const CreepSpectrum&) const = default;
};

/// What multiplies a material's modulus at rest and its moduli of relaxation at a strain amplitude
/// (strain_softening.hpp) [1].
struct SofteningFactors {
  double rest = 1, relaxation = 1;
};

/// The layer's material at its temperature; a scene is such an input. Exact for an elastic layer, a Zener solid,
///   G* = G0 (1+f)(1 + i omega tau) / ((1+f) + i omega tau), 1/G* = [1 + f / (1 + i omega tau)] / (G0 (1+f))
/// (Zehil and Gavin 2013, eq. 41), and a Prony series; a fractional Zener solid is a rule of integration
/// (fractional_zener.hpp), a master curve a fit (master_curve.hpp).
/// @param layer obeys the ranges and check_material
CreepSpectrum creep_spectrum(const MaterialInputs& layer, const SofteningFactors& factors = {});

/// G*(omega) of that spectrum [Pa].
std::complex<double> complex_modulus(const MaterialInputs& layer, double omega);

/// G'(0) [Pa], however it was given.
double static_modulus(const MaterialInputs& layer, const SofteningFactors& factors = {});

/// How the spectrum comes from the inputs where it is not exact, and at which temperature, in words; empty otherwise.
std::string material_route(const MaterialInputs& layer);

/// What is remarkable in the inputs, each as one line: rows of a master curve that are out of order, repeated or far
/// from what a passive material can do, a temperature outside the range of the shift law.
std::vector<std::string> material_warnings(const MaterialInputs& layer);

}  // namespace rollres
