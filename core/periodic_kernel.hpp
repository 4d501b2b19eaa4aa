#pragma once

/// Influence coefficients of a periodic train of bodies: the sum over wavenumbers of Qiu (2006) and of Zehil and
/// Gavin (2013b), folded onto a fast Fourier transform. The second route beside the single passage.

#include "core/influence.hpp"
#include "core/layer_compliance.hpp"
#include "core/material.hpp"

namespace rollres {

/// The sums run over wavenumbers 2 pi n / L, |n| <= terms, in each direction; the period is rounded to a whole number
/// of cells.
/// @param layer of finite thickness   @param period L [m]   @param reach_y 0 for a cylinder
InfluenceTable periodic_table(const CreepSpectrum& material, double speed, const Layer& layer, double period, int terms,
                              double cell_x, double cell_y, int reach_x, int reach_y);

}  // namespace rollres
