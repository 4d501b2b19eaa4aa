#pragma once

/// A measured creep compliance as a relaxation modulus.
///
/// G(t) J(t), which is at most 1, hardly depends on the material: of a power law t^n it is sin(pi n)/(pi n) (Ferry
/// 1980, Viscoelastic Properties of Polymers, ch. 3). It is taken from the non-negative spectrum of creep that meets
/// the table best, and the measured values divide it: an error of J is one of as many percent in G.

#include <vector>

namespace rollres {

/// G(t) of each row [Pa].
/// @param times [s], compliances [1/Pa]  positive, of the same length, in any order
std::vector<double> relaxation_of_creep(const std::vector<double>& times, const std::vector<double>& compliances);

}  // namespace rollres
