#pragma once

/// One wave e^{ikx} of shear tractions across it on bonded layers, followed downwards: what depth_response.hpp is in
/// the plane of the wave. The displacement u_t across it is a sum of e^{-k beta z} and its mirror image from each
/// layer's lower face, with stresses tau_tz = G du_t/dz (z upwards) and tau_lt = i k G u_t along the wave.

#include <complex>
#include <span>
#include <vector>

#include "core/surface/layer_waves.hpp"

namespace rollres {

class TransverseResponse {
 public:
  /// @param moduli G_i of each layer [Pa]   @param wavenumber k > 0 [1/m]   @param speed of the wave, for inertia [m/s]
  /// @param shear the wave's amplitude of the traction across it
  TransverseResponse(const LayeredMedium& medium, std::span<const std::complex<double>> moduli, double wavenumber,
                     double speed, std::complex<double> shear);

  struct State {
    std::complex<double> u;         // across the wave
    std::complex<double> across_z;  // tau_tz, z upwards
    std::complex<double> along;     // tau_lt
  };
  /// @param layer counted from the surface   @param depth below the layer's upper face [m]
  State at(std::size_t layer, double depth) const;

 private:
  struct LayerState {
    LayerWaves waves;
    std::complex<double> stiffness;  // G k
    double thickness;
    std::complex<double> reflected;  // up from the lower face, per what comes down from the upper one
    std::complex<double> down;       // amplitude at the upper face
  };
  double wavenumber_;
  std::vector<LayerState> layers_;
};

}  // namespace rollres
