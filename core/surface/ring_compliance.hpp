#pragma once

/// Surface compliance of rings on a rigid core, one harmonic at a time: covers on rollers and wheels.
///
/// A ring of outer radius R under the tractions e^{i n phi} answers with displacements of the same harmonic
/// (ring_waves.hpp). Rings follow one another from the core outwards. The harmonic n = k R is continuous: the ring is
/// taken to have recovered when it comes round again.
///
/// What slides is the strain along the surface, the hoop strain (du_phi/dphi + u_r)/R, and not du_phi/dx alone: u is
/// the displacement whose slope it is. Under pressure a disc strains as a half-space does, -(1 - 2 nu)/2 p/G at the
/// same place. Of short waves the normal compliance differs from the flat one, by the disc's (Michell's stress
/// functions r^n and r^(n+2))
///     2 k c_ww = [2 (1 - nu) n^2 - (1 - 2 nu) n]/(n^2 - 1)/G
/// Shear does its work on du_phi/dx, the hoop strain less u_r/R. So w under shear is reciprocal to u_phi under
/// pressure, and not to u: its cross term is c_x + c_ww/n, of which the second part, `hoop`, is of order a/R. The power
/// that shear at the radius R gives to the ring is less by tau w/R than that by the hoop strain (core/newton/README.md,
/// (N3e)).

#include <complex>
#include <span>

#include "core/surface/layered_medium.hpp"

namespace rollres {

/// Whether the layers are rings.
bool is_ring(const LayeredMedium& medium);

/// @pre `is_ring(medium)`, without inertia   @param moduli G_i of each ring [Pa]   @param wavenumber k > 0 [1/m]
/// @return as of `surface_compliance`, the hoop's part with it [m/Pa]
SurfaceCompliance ring_compliance(const LayeredMedium& rings, std::span<const std::complex<double>> moduli,
                                  double wavenumber);

}  // namespace rollres
