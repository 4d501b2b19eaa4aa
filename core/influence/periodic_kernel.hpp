#pragma once

/// Influence coefficients of a periodic train of bodies: the sum over wavenumbers of Qiu (2006) and of Zehil and
/// Gavin (2013b), folded onto a fast Fourier transform (core/influence/README.md, (K15)). The second route beside the
/// single passage.

#include <functional>

#include "core/influence/influence.hpp"
#include "core/material/material.hpp"
#include "core/surface/layer_compliance.hpp"
#include "core/surface/layered_medium.hpp"

namespace rollres {

/// Compliance (K1) of a surface for wavenumbers ky across the motion, made for one kx along it; k = 0 included [m/Pa].
using SymbolsAcross = std::function<SurfaceCompliance(double across)>;
using SymbolsAlong = std::function<SymbolsAcross(double along)>;

/// The sums run over wavenumbers 2 pi n / L, |n| <= terms, in each direction; the period is rounded to a whole number
/// of cells.
/// @param period L [m]   @param reach_y 0 for a cylinder   @param ring whether the hoop's part is wanted, of a cylinder
InfluenceTable periodic_table(const SymbolsAlong& symbols, double period, int terms, double cell_x, double cell_y,
                              int reach_x, int reach_y, bool ring = false);

}  // namespace rollres
