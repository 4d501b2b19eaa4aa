#pragma once

/// A layered medium as a sum of elastic surfaces with exponential memories: the expansion of its compliance in fixed
/// retardation times (medium_expansion.hpp), each term turned into tables of the distance.

#include <vector>

#include "core/medium_expansion.hpp"
#include "core/surface_shape.hpp"

namespace rollres {

/// One retardation time's elastic response, in units of compliance.
struct TimedShape {
  double time;  ///< [s]; 0: instantaneous
  SurfaceShape shape;
};

/// Corrections are transformed by quadrature over wavenumbers; the tables end where the surface is at rest, and over a
/// half-space where it has become that of the base but for a power of the distance.
std::vector<TimedShape> medium_shapes(Indenter indenter, const LayeredMedium& medium, const MediumExpansion& expansion);

}  // namespace rollres
