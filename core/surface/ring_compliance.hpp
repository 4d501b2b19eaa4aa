#pragma once

/// Surface compliance of rings on a rigid core, one harmonic at a time: covers on rollers and wheels.
///
/// A ring of outer radius R under the tractions e^{i n phi} answers with displacements of the same harmonic
/// (ring_waves.hpp). Rings follow one another from the core outwards. The harmonic n = k R is continuous: the ring is
/// taken to have recovered when it comes round again.
///
/// What slides and what does work is the strain along the surface, (du_phi/dphi + u_r)/R, and not du_phi/dx alone: the
/// compliance along is that of a displacement whose slope is this strain. Under pressure a disc strains as a half-space
/// does, -(1 - 2 nu)/2 p/G at the same place, and so do its cross terms: of short waves, the normal compliance alone
/// differs from the flat one, by the disc's (Michell's stress functions r^n and r^(n+2))
///     2 k c_ww = [2 (1 - nu) n^2 - (1 - 2 nu) n]/(n^2 - 1)/G
/// Shear moves the surface radially by the same cross term, so that an elastic ring takes no power from its tractions.

#include <complex>
#include <span>

#include "core/surface/layered_medium.hpp"

namespace rollres {

/// Whether the layers are rings.
bool is_ring(const LayeredMedium& medium);

/// @pre `is_ring(medium)`, without inertia   @param moduli G_i of each ring [Pa]   @param wavenumber k > 0 [1/m]
/// @return c_ww, c_ll and c_x as of `surface_compliance` [m/Pa]; the transverse one is 0
SurfaceCompliance ring_compliance(const LayeredMedium& rings, std::span<const std::complex<double>> moduli,
                                  double wavenumber);

}  // namespace rollres
