#pragma once

/// Special functions of an exponential memory along a contact with continuous edges, scaled so that nothing overflows.

#include <Eigen/Core>

namespace rollres {

/// e^{-x} I_n(x) for n = 0 ... count - 1, x >= 0: the Chebyshev coefficients of e^{x (t - 1)} on [-1, 1], n > 0 halved.
Eigen::VectorXd scaled_bessel_i(double x, int count);

/// e^{x} K_0(x) and e^{x} K_1(x), x > 0.
struct ScaledBesselK {
  double order_0, order_1;
};
ScaledBesselK scaled_bessel_k(double x);

/// b_n(x) = x int_0^inf e^{-x (cosh h - 1)} e^{-n h} sinh h dh for n = 0 ... count - 1, x > 0 (b_0 = 1): the mean over
/// an exponential memory of length l/x beyond the edge of a contact of half-length l of the slope that pressures sqrt(1
/// - t^2) U_{n-1}(t) give a half-space there (core/spectral/README.md, (S12)). Between 0 and 1; relative accuracy is
/// kept as x -> 0.
/// @param k of the same x
Eigen::VectorXd edge_memory(double x, int count, const ScaledBesselK& k);

/// e^{x} E_1(x), x > 0.
double scaled_exponential_integral(double x);
/// e^{-x} Ei(x), x > 0, the principal value.
double scaled_growing_integral(double x);
/// PV int_0^inf e^{-s/T}/T /(x + s) ds, x != 0, T > 0: the mean of a pole over a memory.
double remembered_pole(double x, double length);

/// Ci(x) and Si(x), x > 0 (Abramowitz and Stegun, section 5.2).
struct TrigonometricIntegrals {
  double cosine, sine;
};
TrigonometricIntegrals trigonometric_integrals(double x);

}  // namespace rollres
