#pragma once

/// A cheap estimate of the contact of a rigid body pressed without friction on an incompressible elastic layer bonded
/// to a rigid base: the size of a grid, the first guess of an iteration.
///
/// With the half-width over the thickness alpha = a/H, load and approach are
///     cylinder  P R / (pi G a^2) = f(alpha),  d R / a^2 = g(alpha),
///     sphere    P R / (G a^3)    = f(alpha),  d R / a^2 = g(alpha).
/// f and g are a spline through tabulated solutions for 0.1 <= alpha <= 20, continued to the half-space (Hertz; for the
/// cylinder's approach the logarithm of Johnson 1985, section 5.6) and to the thin layer (P ~ (a + b H)^5 or ^6, whose
/// leading terms are the lubrication limits P = 2 G a^5/(15 R H^3), d = a^2/6R and P = pi G a^6/(32 R H^3), d =
/// a^2/4R). Within 1 % in half-width and approach at any alpha for an incompressible elastic layer. For a viscoelastic
/// layer the rubbery and the glassy modulus give the widest and the narrowest contact under a given load.
///
/// A compressible layer (nu < 1/2) is blended from its limits: the half-space of modulus G/(2 - 2 nu); and, for what
/// the base adds, the confined incompressible layer in series with a foundation of modulus 2 G (1 - nu)/(1 - 2 nu) over
/// H (Johnson 1985, section 5.8). Within 20 % in half-width.

#include <string>
#include <string_view>

#include "core/model/contact_model.hpp"

namespace rollres {

/// @param dimension 2: of a cylinder; 3: of a sphere   @param radius R [m]   @param shear_modulus G [Pa]
/// @param load P [N/m] for a cylinder, [N] for a sphere
/// @throws std::invalid_argument naming the first argument that is not positive; std::domain_error `no_half_width`
ContactEstimate elastic_contact_from_load(int dimension, double radius, const Layer& layer, double shear_modulus,
                                          double load);

/// @param approach d [m]; other arguments as above
/// @throws std::invalid_argument naming the first argument that is not positive, and for a cylinder on a half-space,
/// whose approach says nothing about its contact
ContactEstimate elastic_contact_from_approach(int dimension, double radius, const Layer& layer, double shear_modulus,
                                              double approach);

/// Says that no contact answers the load or the approach that is given.
std::string no_half_width(std::string_view given, double value);

}  // namespace rollres
