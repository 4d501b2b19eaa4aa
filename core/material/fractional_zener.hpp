#pragma once

/// The fractional Zener solid: a Zener solid whose dashpot is a spring-pot.

#include <complex>

#include "core/material/material.hpp"

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

/// Its spectrum of creep. 1/G* = [1 + f / (1 + z)] / (G0 (1 + f)) has the continuous spectrum of Cole and Cole,
///   1/(1 + z) = int L(s) / (1 + i omega tau e^s) ds,
///   L(s) = sin(pi order) / (2 pi (cosh(order s) + cos(pi order))),
/// taken at equal steps of a variable that is fine where L is narrow: 1/G* is met to 1e-7 of 1/G0 within 12 decades of
/// 1/tau either way, for any order; G'(0) and G'(infinity) are exact. Order 1 is the Zener solid itself.
/// @see Cole and Cole (1941), J. Chem. Phys. 9, 341; Trefethen and Weideman (2014), SIAM Review 56, 385
CreepSpectrum creep_spectrum(const FractionalZener& solid);

}  // namespace rollres
