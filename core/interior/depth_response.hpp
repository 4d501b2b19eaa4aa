#pragma once

/// One wave e^{ikx} of tractions on bonded layers, followed downwards: displacements and stresses at any depth.
///
/// In each layer waves e^{-k alpha z}, e^{-k beta z} come down from its upper face and go up from its lower one
/// (surface/layered_medium.hpp). From the base up, those that go up are told by those that come down; from the surface
/// down, each layer's top has the stress that the bottom of the layer above has. Only decaying exponentials appear.

#include <complex>
#include <span>
#include <vector>

#include "core/interior/surface_tractions.hpp"
#include "core/surface/layer_waves.hpp"

namespace rollres {

/// A wave's displacements [m] and stresses [Pa] at a depth; z and w upwards.
struct DepthState {
  std::complex<double> u, w;
  PlaneStress stress;
};

class DepthResponse {
 public:
  /// Wavenumber times distance beyond which waves have vanished.
  static constexpr double vanished = 38;

  /// @param moduli G_i of each layer [Pa]   @param wavenumber k > 0 [1/m]   @param speed of the wave, for inertia [m/s]
  /// @param tractions the wave's amplitude, p and q
  DepthResponse(const LayeredMedium& medium, std::span<const std::complex<double>> moduli, double wavenumber,
                double speed, const SurfaceTractions::Transforms& tractions);

  /// @param layer counted from the surface   @param depth below the layer's upper face [m]
  DepthState at(std::size_t layer, double depth) const;

 private:
  struct LayerState {
    LayerWaves waves;
    std::complex<double> modulus;
    double thickness, poisson_ratio;
    Eigen::Matrix2cd reflected;  // up from the lower face, per what comes down
    Eigen::Vector2cd down;       // amplitudes at the upper face
  };
  double wavenumber_;
  std::vector<LayerState> layers_;
};

}  // namespace rollres
