#pragma once

/// What a layer of unit thickness and unit shear modulus adds to the half-space under a point or a line load, as tables
/// of the distance over the thickness. Singular at complex distances of about +-2i only.

#include <memory>

#include "core/numerics/chebyshev.hpp"

namespace rollres {

/// Distance over thickness where the tables end: beyond it the layer is at rest.
inline constexpr double layer_table_end = 30.0;

/// Radial functions of r/H [1/H], k c'(k)/(2 pi) against Bessel functions, c' the layer's symbols less the
/// half-space's: normal (J0), mean tangential (J0), half difference tangential (J2), cross (J1): f_0 to f_3 of
/// core/influence/README.md, (K5).
using RadialTable = ChebyshevTable<4>;

/// Antiderivatives over x/H of the correction to a line load, less the part (1 - e^{-2kH}) times the half-space's
/// symbol that is known in closed form: normal, longitudinal [1], cross [1]; the integrals of (K6).
using LineTable = ChebyshevTable<3>;

/// Their slopes, the corrections themselves: in cells that are short against the layer the difference of two
/// antiderivatives has no digits left.
struct LineSlopes : ChebyshevTable<3> {
  using ChebyshevTable::ChebyshevTable;
};

/// Tables for a Poisson's ratio, from a small cache shared by all threads; that of an incompressible layer is kept.
std::shared_ptr<const RadialTable> radial_table(double poisson_ratio);
std::shared_ptr<const LineTable> line_table(double poisson_ratio);
std::shared_ptr<const LineSlopes> line_slopes(double poisson_ratio);

}  // namespace rollres
