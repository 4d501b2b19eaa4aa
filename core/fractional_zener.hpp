#pragma once

/// The fractional Zener solid: a Zener solid whose dashpot is a spring-pot.

#include <complex>

namespace rollres {

/// G*(omega) = G0 (1 + f) (1 + z) / (1 + f + z), z = (i omega tau)^order; order 1 is the Zener solid.
/// @see Mainardi (2010), Fractional Calculus and Waves in Linear Viscoelasticity, section 3.2
struct FractionalZener {
  double static_modulus = 0;  ///< G0 = G'(0) [Pa], > 0
  double stiffening = 0;      ///< f = G'(infinity)/G'(0) - 1 [1], >= 0
  double creep_time = 0;      ///< tau [s], > 0
  double order = 1;           ///< above 0, up to 1
};

/// G*(omega) [Pa], omega [rad/s] of either sign.
std::complex<double> complex_modulus(const FractionalZener& solid, double omega);

}  // namespace rollres
