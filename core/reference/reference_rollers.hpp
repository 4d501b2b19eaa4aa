#pragma once

/// Free rolling (T = 0) of a rigid cylinder on a compressible elastic half-space: its surface is drawn inwards under
/// the pressure, which makes the roller creep and slip although no force is asked of it.
///
/// Slopes of the surface under a pressure p and a shear q, u along x, w into the half-space (Johnson 1985, eq. 2.25):
///     u' = -(K/G) p - ((1 - nu)/(pi G)) int q(s)/(x - s) ds,   K = (1 - 2 nu)/2,                        (1)
///     w' =  (K/G) q - ((1 - nu)/(pi G)) int p(s)/(x - s) ds = -x/R.                                     (2)
/// Slip over V is u' + creepage, the slip of a flat surface (kinematics "printed"). With kappa = 2 K/(1 - nu) and
/// Hertz's half-width a0 = sqrt(2 (1 - nu) P R/(pi G)), -u' under Hertz's pressure is (kappa a0/2R) sqrt(1 - (x/a0)^2).
/// The tests put both solutions into (1) and (2).
/// @see Bentall and Johnson (1967), Int. J. Mech. Sci. 9, 389, who solve what lies between

namespace rollres {

/// The limit mu -> 0: all slips, q = mu p backwards in the middle and forwards outside, in balance.
struct FullSlipLine {
  double half_width;          ///< a0 [m]
  double reversal;            ///< |x| at which the slip turns [m]: half of the load acts within
  double creepage;            ///< 1 - R Omega/V [1] = 0.457386 kappa a0/R
  double rolling_resistance;  ///< what friction takes [N/m]: 0.123922 mu P kappa a0/2R
};

/// @param radius R [m]   @param load P [N/m]   @param shear_modulus G [Pa]   @param poisson_ratio nu [1], 0 to below
/// 1/2
/// @param friction_coefficient mu [1], small beside kappa
/// @throws std::invalid_argument naming the first argument outside its range
FullSlipLine full_slip_line(double radius, double load, double shear_modulus, double poisson_ratio,
                            double friction_coefficient);

/// The limit mu -> infinity: nothing slips and nothing is lost. With beta = kappa/2, eta = ln((1 + beta)/(1 - beta))/2
/// pi:
///     p + i q = (2 P cosh(pi eta)/(pi a0^2)) sqrt(a^2 - x^2) ((a + x)/(a - x))^(i eta).
struct NoSlipLine {
  double half_width;    ///< a = a0/sqrt(1 + 4 eta^2) [m]
  double exponent;      ///< eta [1]
  double creepage;      ///< 1 - R Omega/V [1] = 2 eta a/R
  double mid_pressure;  ///< p(0) [Pa]
  /// p(x) and q(x) [Pa] at x [m] ahead of the axis; 0 outside the contact.
  double pressure(double x) const;
  double shear(double x) const;
};

/// @param radius R [m]   @param load P [N/m]   @param shear_modulus G [Pa]   @param poisson_ratio nu [1], 0 to 1/2
/// @throws std::invalid_argument naming the first argument outside its range
NoSlipLine no_slip_line(double radius, double load, double shear_modulus, double poisson_ratio);

}  // namespace rollres
