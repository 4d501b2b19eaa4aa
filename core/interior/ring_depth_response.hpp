#pragma once

/// One wave of tractions on rings, followed inwards: displacements and stresses at any radius.
///
/// From the core up, each ring's outer face yields as its inner one does (surface/ring_waves.hpp); from the surface
/// down, the stresses on an inner face follow from those on the outer one. Steps are so short that no wave grows much
/// in one. x is measured along the outer face, x = R phi, z is up, from the core outwards.

#include <complex>
#include <span>
#include <vector>

#include "core/interior/depth_response.hpp"
#include "core/surface/ring_waves.hpp"

namespace rollres {

class RingDepthResponse {
 public:
  /// @pre `is_ring(rings)`   @param moduli G_i of each ring [Pa]   @param wavenumber k > 0 along the outer face [1/m]
  RingDepthResponse(const LayeredMedium& rings, std::span<const std::complex<double>> moduli, double wavenumber,
                    const SurfaceTractions::Transforms& tractions);

  /// @param ring counted from the surface   @param depth below its outer face [m]; 0 where the wave has vanished
  DepthState at(std::size_t ring, double depth) const;

 private:
  struct Ring {
    RingWaves waves;
    std::complex<double> modulus;
    double outer, poisson_ratio;           // [m], [1]
    double step;                           // in ln r
    std::vector<Eigen::Vector4cd> states;  // at the inner end of each step, from the core outwards
  };
  double harmonic_;
  std::vector<Ring> rings_;
};

}  // namespace rollres
