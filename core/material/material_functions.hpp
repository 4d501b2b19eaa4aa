#pragma once

/// What a layer's material does in time and frequency: creep, relaxation, loss.

#include <vector>

#include "core/material/material.hpp"
#include "core/material/prony_series.hpp"

namespace rollres {

/// J(t), strain after a unit stress was applied [1/Pa]. @param time [s], >= 0
double creep_compliance(const CreepSpectrum& creep, double time);

/// G(t), stress after a unit strain was applied [Pa]. @param time [s], >= 0
double relaxation_modulus(const RelaxationSpectrum& relaxation, double time);

/// G"/G' [1]. @param omega [rad/s]
double loss_tangent(const CreepSpectrum& creep, double omega);

/// lim G"/(omega G') for omega -> 0 [s]: without friction a body rolls slowly with R_r/P = V/R of it.
double slow_loss_time(const CreepSpectrum& creep);

/// Angular frequencies that span all times of the spectrum and a decade beyond, even in their logarithm; of an elastic
/// material those about 1 rad/s. @param per_decade at least 1
std::vector<double> angular_frequencies(const CreepSpectrum& creep, int per_decade);

struct LossPeak {
  double omega;    ///< [rad/s]
  double tangent;  ///< of loss [1]
};

/// The maxima of the loss tangent, frequencies ascending.
std::vector<LossPeak> loss_peaks(const CreepSpectrum& creep);

/// The relaxation modulus G(t) of rows of a creep test [Pa].
///
/// G(t) J(t), which is at most 1, hardly depends on the material: of a power law t^n it is sin(pi n)/(pi n) (Ferry
/// 1980, Viscoelastic Properties of Polymers, ch. 3). It is taken from a spectrum of creep, few terms of free times or
/// a smooth one as of a master curve, and the measured values divide it: an error of J is one of as many percent in G.
/// @param times [s], compliances [1/Pa]  positive, of the same length, in any order
std::vector<double> relaxation_of_creep(const std::vector<double>& times, const std::vector<double>& compliances);

}  // namespace rollres
