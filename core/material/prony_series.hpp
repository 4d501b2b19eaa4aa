#pragma once

/// A Prony series in relaxation moduli and times (generalised Maxwell solid), and the way between the spectra of creep
/// and of relaxation.

#include <complex>
#include <vector>

#include "core/material/material.hpp"

namespace rollres {

/// G*(omega) = static_modulus + sum_j modulus_j i omega time_j / (1 + i omega time_j).
struct PronySeries {
  struct Term {
    double modulus;  ///< [Pa], > 0
    double time;     ///< relaxation time [s], > 0
  };
  double static_modulus = 0;  ///< G'(0) [Pa], > 0
  std::vector<Term> terms;    ///< times ascending
};

/// G*(omega) [Pa], omega [rad/s] of either sign.
std::complex<double> complex_modulus(const PronySeries& series, double omega);

/// G(t) [Pa], t [s] >= 0.
double relaxation_modulus(const PronySeries& series, double time);

/// The series with its terms in order, equal times as one and moduli that are zero left out.
PronySeries ordered(PronySeries series);

/// The spectrum of creep that belongs to it, exactly: as many terms, one just above each relaxation time. The inverse
/// of relaxation_spectrum.
/// @param series with times ascending and all different
CreepSpectrum creep_spectrum(const PronySeries& series);

/// The relaxation spectrum that belongs to a creep spectrum: its inverse in the Laplace domain.
/// G*(omega) = instantaneous - sum_j modulus_j / (1 + i omega time_j).
struct RelaxationSpectrum {
  struct Term {
    double modulus;  // [Pa], > 0
    double time;     // relaxation time [s]
  };
  double instantaneous = 0;  // G'(infinity) [Pa]
  std::vector<Term> terms;   // one just below each retardation time
};

/// @param creep with positive times, all different, ascending, and positive compliances
RelaxationSpectrum relaxation_spectrum(const CreepSpectrum& creep);

}  // namespace rollres
