#include "core/interior/transverse_response.hpp"

#include <cmath>

#include "core/interior/depth_response.hpp"

namespace rollres {

using complex = std::complex<double>;

TransverseResponse::TransverseResponse(const LayeredMedium& medium, std::span<const complex> moduli, double wavenumber,
                                       double speed, complex shear)
    : wavenumber_(wavenumber) {
  layers_.reserve(medium.size());
  for (std::size_t i = 0; i < medium.size(); ++i)
    layers_.push_back({LayerWaves(wavenumber, moduli[i], medium[i], speed), moduli[i] * wavenumber, medium[i].thickness,
                       complex(0), complex(0)});
  // From the base up: stress G du/d(depth) at the upper face per amplitude coming down.
  std::vector<complex> stress_per_wave(medium.size());
  complex below = 0;  // displacement per stress of what lies below
  for (std::size_t i = medium.size(); i-- > 0;) {
    LayerState& layer = layers_[i];
    const complex rigidity = layer.stiffness * layer.waves.beta();
    complex up = 0;
    if (std::isfinite(layer.thickness)) {
      const complex decay = layer.waves.transverse_decay(layer.thickness), give = below * rigidity;
      layer.reflected = -(1.0 + give) / (1.0 - give) * decay;
      up = layer.reflected * decay;
    }
    stress_per_wave[i] = rigidity * (up - 1.0);
    below = (1.0 + up) / stress_per_wave[i];
  }
  complex stress = -shear;
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    LayerState& layer = layers_[i];
    layer.down = stress / stress_per_wave[i];
    if (std::isinf(layer.thickness)) break;
    stress = layer.stiffness * layer.waves.beta() * layer.down *
             (layer.reflected - layer.waves.transverse_decay(layer.thickness));
  }
}

TransverseResponse::State TransverseResponse::at(std::size_t index, double depth) const {
  const LayerState& layer = layers_[index];
  const complex down = layer.down * layer.waves.transverse_decay(depth);
  complex up = 0;
  if (wavenumber_ * (layer.thickness - depth) < DepthResponse::vanished)
    up = layer.down * layer.reflected * layer.waves.transverse_decay(layer.thickness - depth);
  const complex u = down + up;
  return {.u = u,
          .across_z = layer.stiffness * layer.waves.beta() * (down - up),
          .along = complex(0, 1) * layer.stiffness * u};
}

}  // namespace rollres
