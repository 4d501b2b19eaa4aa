#pragma once

/// Closed forms and tabulated solutions that a solver of rolling contact must reproduce. Nothing here uses the solver.
///
/// Incompressible (nu = 1/2) half-space or bonded layer; body of radius R, load P, shear modulus G. Hunter's
/// viscoelastic cylinder stands in reference_hunter.hpp. Every function throws std::invalid_argument naming the first
/// argument that is outside its range.

#include <array>

#include "core/reference/reference_hunter.hpp"

namespace rollres {

/// A cylinder pressed on a half-space (see hertz_line).
struct HertzLine {
  double half_width;     ///< a [m]
  double peak_pressure;  ///< p0 [Pa]
  /// p(x) [Pa] at x [m] from the axis.
  double pressure(double x) const;
};

/// A sphere pressed on a half-space (see hertz_sphere).
struct HertzSphere {
  double half_width;     ///< a [m], radius of the contact
  double approach;       ///< d [m]
  double peak_pressure;  ///< p0 [Pa]
  /// p(r) [Pa] at r [m] from the axis.
  double pressure(double r) const;
  /// Mean of r^2 weighted with the pressure [m2].
  double mean_square_position() const { return 2 * half_width * half_width / 5; }
};

/// Presses a cylinder on a half-space: a = sqrt(P R / (pi G)), p0 = 2 P / (pi a).
/// @param radius R [m]   @param load P [N/m]   @param shear_modulus G [Pa]
/// @see Johnson (1985), section 4.2
HertzLine hertz_line(double radius, double load, double shear_modulus);

/// Presses a sphere on a half-space: a^3 = 3 P R / (16 G), d = a^2/R, p0 = 3 P / (2 pi a^2).
/// @param radius R [m]   @param load P [N]   @param shear_modulus G [Pa]
/// @see Johnson (1985), section 4.2
HertzSphere hertz_sphere(double radius, double load, double shear_modulus);

/// The limit a >> H of a frictionless contact on a bonded layer, p = p0 (1 - (x/a)^2)^2. It is approached slowly: at
/// a/H = 20 the true load for a given a is still 42 % (cylinder) and 52 % (sphere) above it.
struct ThinLayerContact {
  double half_width;            ///< a [m], radius of the contact for a sphere
  double approach;              ///< d [m]
  double peak_pressure;         ///< p0 [Pa]
  double mean_square_position;  ///< mean of x^2 (r^2 for a sphere) weighted with the pressure [m2]
  /// p [Pa] at x [m] from the axis.
  double pressure(double x) const;
};

/// Cylinder on a thin layer: P = 2 G a^5 / (15 R H^3), d = a^2/6R, p0 = G a^4 / (8 R H^3).
/// @param radius R [m]   @param layer_thickness H [m]   @param load P [N/m]   @param shear_modulus G [Pa]
/// @see Johnson (1985), section 5.8; from the lubrication equation (H^3/3G) p'' = -(d - x^2/2R), p = p' = 0 at a
ThinLayerContact thin_layer_line(double radius, double layer_thickness, double load, double shear_modulus);

/// Sphere on a thin layer: P = pi G a^6 / (32 R H^3), d = a^2/4R, p0 = 3 G a^4 / (32 R H^3).
/// @param radius R [m]   @param layer_thickness H [m]   @param load P [N]   @param shear_modulus G [Pa]
ThinLayerContact thin_layer_sphere(double radius, double layer_thickness, double load, double shear_modulus);

/// Frictionless contact on an elastic bonded layer, at one ratio of half-width to thickness.
struct ElasticLayerRow {
  double width_ratio;        ///< a/H [1]
  double sphere_load;        ///< P R / (G a^3) [1]
  double sphere_flatness;    ///< a^2 / (R d) [1]
  double cylinder_load;      ///< P R / (pi G a^2) [1]
  double cylinder_approach;  ///< d R / a^2 [1]
};

/// Solutions of the integral equations of the contact (cylinder: collocation of the slope; sphere: Lebedev and Ufliand
/// 1958), converged to the digits shown; the tests solve them again. Dense solutions by another program agree in every
/// digit but the cylinder's d R / a^2, which they have to 1e-3. Both ends tend to Hertz and to the thin layer.
inline constexpr std::array<ElasticLayerRow, 7> elastic_layer_table{{{0.1, 5.33761, 1.08018, 1.01022, 1.27382},
                                                                     {0.3, 5.43854, 1.25871, 1.09106, 0.787911},
                                                                     {0.5, 5.75417, 1.43627, 1.24748, 0.609056},
                                                                     {1, 7.52267, 1.78758, 1.90330, 0.438344},
                                                                     {2, 13.8566, 2.19827, 4.04782, 0.332296},
                                                                     {5, 53.0469, 2.78455, 18.2833, 0.247165},
                                                                     {20, 1195.77, 3.52642, 482.229, 0.189717}}};

/// tau' = lim G"/(omega G') at low frequency = f tau/(1 + f) [s] for a Zener solid.
double slow_loss_time(double stiffening, double creep_time);
/// tau" = lim G'/(omega G") at high frequency = tau/f [s] for a Zener solid; infinite if f = 0.
double fast_loss_time(double stiffening, double creep_time);

/// Rolling resistance without friction as V -> 0, whatever the thickness: R_r = P V tau'/R [N/m or N].
/// @param load P [N/m or N]   @param radius R [m]   @param speed V [m/s]   @param loss_time tau' [s]
double slow_rolling_resistance(double load, double radius, double speed, double loss_time);

/// Rolling resistance without friction as V -> infinity: R_r = int p (d - x^2/2R) dA / (V tau") [N/m or N], from the
/// elastic fields with the glassy modulus. Not for a cylinder on a half-space, which has no approach.
/// @param load P [N/m or N]   @param approach d [m]   @param mean_square_position int p x^2 dA / P [m2]
/// @param radius R [m]   @param speed V [m/s]   @param loss_time tau" [s]
double fast_rolling_resistance(double load, double approach, double mean_square_position, double radius, double speed,
                               double loss_time);

/// R_r/P = coefficient tan(delta) a/R without friction when the loss angle is small and the same at all frequencies:
/// R_r = tan(delta) int |kx| C(k) |p^(k)|^2, p the elastic pressure, C = 1/(2 G k) for the half-space and k^2 H^3/(3 G)
/// for the thin layer.
struct ConstantLossCoefficients {
  double half_space_cylinder;  ///< 8/(3 pi)
  double half_space_sphere;    ///< 6/pi^2
  double thin_layer_cylinder;  ///< 5/(6 pi)
  double thin_layer_sphere;    ///< 96/(35 pi^2)
};
ConstantLossCoefficients constant_loss_coefficients();

/// Tractive rolling of a rigid cylinder on an elastic half-space (see carter_line). Positive for a driven body.
struct CarterLine {
  double half_width;          ///< a [m]
  double stick_half_width;    ///< a' [m]; the stick zone reaches from a - 2 a' to a, the leading edge
  double creepage;            ///< R Omega / V - 1 [1]
  double tangential_force;    ///< T/R [N/m], T the torque about the axis
  double rolling_resistance;  ///< what friction takes: T/R times the creepage [N/m]
  double limit_pressure;      ///< friction coefficient times p0 [Pa]
  double sign;                ///< 1 driven, -1 braked, 0 neither
  /// tau_xz on the half-space [Pa] at x [m] ahead of the axis.
  double shear(double x) const;
};

/// Carter's solution: |creepage| = mu (a - a')/R, |T|/R = mu P (1 - (a'/a)^2).
/// @param radius R [m]   @param load P [N/m]   @param shear_modulus G [Pa]   @param friction_coefficient mu [1]
/// @param torque T about the axis [N], smaller than mu P R either way
/// @see Carter (1926), Proc. R. Soc. A 112, 151; Johnson (1985), section 8.3
CarterLine carter_line(double radius, double load, double shear_modulus, double friction_coefficient, double torque);

/// Kalker's coefficients of linear creep for a circular contact.
struct KalkerCoefficients {
  double c11, c22, c23;  // [1]
};
/// @param poisson_ratio 1/4 or 1/2, the values tabulated here
/// @see Kalker (1990), Three-Dimensional Elastic Bodies in Rolling Contact, creepage and spin coefficients
KalkerCoefficients kalker_circle(double poisson_ratio);

/// F_x [N] on the body for a small creepage without spin, rigid sphere on an incompressible half-space:
/// |F_x| = 2 G a^2 C11 |creepage| (a rigid body on a half-space of modulus G counts as two bodies of 2 G).
/// @param half_width a [m]   @param shear_modulus G [Pa]   @param creepage R Omega / V - 1 [1], of either sign
double kalker_force(double half_width, double shear_modulus, double creepage);

}  // namespace rollres
