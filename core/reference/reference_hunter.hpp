#pragma once

/// Frictionless rolling or sliding of a rigid cylinder on a Zener half-space (nu = 1/2), in closed form.
///
/// With T = V tau, T_r = T/(1 + f), E0* = 4 G0, half-width l, centre c (ahead of the axis), z = l/T, y = l/T_r:
///     c   = (T - T_r) I1(y) K0(z) / (I1(y) K0(z) + I0(y) K1(z))                                        (1)
///     P   = (pi E0* l / 4R) (l + 2 c K1(z)/K0(z))                                                      (2)
///     R_r = (1/R) int p x dx = (1/R) [(c - T_r) P + (pi E0* l^2 / 4R) (T - c)]                         (3)
///     p(s) = (1/t) int_s^1 q(s') exp((s - s')/t) ds',  s = (x - c)/l,  t = T_r/l,                      (4)
///     q(s) = (E0*/2R) [l sqrt(1 - s^2) + ((T - c) s + c K1(z)/K0(z)) / sqrt(1 - s^2)].
/// Equation (2) is solved for l between the glassy and the rubbery Hertz half-width, which bracket it.
/// @see Hunter (1961), J. Appl. Mech. 28, 611; Goryacheva (1973), J. Appl. Math. Mech. 37, 877;
///      Goryacheva (1998), Contact Mechanics in Tribology

namespace rollres {

struct HunterLine {
  double half_width;          ///< l [m]
  double centre;              ///< c [m], > 0: ahead of the axis
  double rolling_resistance;  ///< R_r [N/m]
  double peak_pressure;       ///< [Pa]

  double leading_edge() const { return centre + half_width; }   // [m]
  double trailing_edge() const { return centre - half_width; }  // [m]
  /// p(x) [Pa] at x [m] ahead of the axis; 0 outside the contact.
  double pressure(double x) const;

  // What equation (4) is made of.
  double stress_scale;       ///< E0*/2R [Pa/m]
  double creep_length;       ///< T = V tau [m]
  double relaxation_length;  ///< T_r = V tau/(1 + f) [m]
  double edge_term;          ///< c K1(z)/K0(z) [m]
};

/// @param radius R [m]   @param load P [N/m]   @param static_shear_modulus G0 [Pa]   @param stiffening f [1], may be 0
/// @param creep_time tau [s], may be 0   @param speed V [m/s]
/// Any ratio of V tau to the half-width: tested from 1e-6 to 1e6.
/// @throws std::invalid_argument naming the first argument outside its range
HunterLine hunter_line(double radius, double load, double static_shear_modulus, double stiffening, double creep_time,
                       double speed);

}  // namespace rollres
