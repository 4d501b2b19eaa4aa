#pragma once

/// Surface compliance of several bonded layers, one wavenumber at a time.
///
/// Layers i = 1, 2, ... from the surface down, each of thickness h_i, Poisson's ratio nu_i, density rho_i and modulus
/// G_i, bonded to each other and to a rigid base, or the last one a half-space. The tractions e^{i k x} at the surface
/// move at speed V; cos is that of the angle between the wave vector and the motion. In a layer, with depth z,
///     epsilon = rho V^2 cos^2 / G,   beta^2 = 1 - epsilon,   alpha^2 = 1 - epsilon (1 - 2 nu)/(2 - 2 nu),
/// the displacements along the wave vector and downwards are sums of e^{-k alpha z} (1, alpha), e^{-k beta z} (beta, 1)
/// and their mirror images from the layer's lower face (Achenbach 1973, section 5.11). The second is replaced by the
/// difference of both over epsilon, so that nothing cancels at rest, where it becomes (.. k z) e^{-k z}. From the base
/// up, each layer's decaying waves are reflected at what lies below: no growing exponential appears.

#include <cmath>
#include <complex>
#include <span>
#include <vector>

#include "core/material/material.hpp"
#include "core/surface/layer_compliance.hpp"

namespace rollres {

/// One layer of a medium; the last one's thickness may be infinite.
struct MediumLayer {
  double thickness;      ///< [m]
  double poisson_ratio;  ///< [1]
  double density;        ///< [kg/m3]; 0: without inertia
  CreepSpectrum material;
  double radius = INFINITY;  ///< of the face towards the contact, of a ring on its core [m]; infinite: flat

  bool operator==(const MediumLayer&) const = default;
};

/// From the surface down; on a rigid base unless the last layer is infinite. Rings have the first one's outer radius in
/// all of them, each less what lies above it (ring_compliance.hpp).
using LayeredMedium = std::vector<MediumLayer>;

/// Thickness of the layers that are not infinite [m].
double finite_thickness(const LayeredMedium& medium);

/// Displacement per traction [m/Pa], as in LayerSymbols but with the moduli.
struct SurfaceCompliance {
  std::complex<double> normal, longitudinal, cross, transverse;
  std::complex<double> hoop =
      0;  ///< of a ring: what the cross term of w under shear has besides that of u under pressure
};

/// Of rings by `ring_compliance`.
/// @param moduli G_i of each layer [Pa]   @param wavenumber k > 0 [1/m]   @param wave_speed V cos, for the inertia
/// [m/s]
SurfaceCompliance surface_compliance(const LayeredMedium& medium, std::span<const std::complex<double>> moduli,
                                     double wavenumber, double wave_speed);

/// The half-space of one layer's material, times the wavenumber: the same at any [1/Pa].
SurfaceCompliance half_space_compliance(const MediumLayer& layer, std::complex<double> modulus, double wave_speed);

/// In steady motion: with the moduli at the frequency -k V cos.
/// @param cosine of the angle between wave vector and motion   @param speed V [m/s]
SurfaceCompliance surface_compliance(const LayeredMedium& medium, double wavenumber, double cosine, double speed);

/// Whether the layers at rest together carry waves along the surface that are slower than a speed [m/s] below that of
/// Rayleigh waves on each: a heavy layer slows those of a softer one below. The response to slower loads of any
/// wavenumber takes work, that is, its compliance is positive.
bool carries_slower_waves(const LayeredMedium& medium, double speed);

/// Moduli of the layers at a frequency [rad/s].
std::vector<std::complex<double>> moduli_at(const LayeredMedium& medium, double omega);

}  // namespace rollres
