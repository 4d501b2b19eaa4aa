#include "core/interior/depth_response.hpp"

#include <cmath>

namespace rollres {

using complex = std::complex<double>;
using Matrix2 = Eigen::Matrix2cd;
using Vector2 = Eigen::Vector2cd;

DepthResponse::DepthResponse(const LayeredMedium& medium, std::span<const complex> moduli, double wavenumber,
                             double speed, const SurfaceTractions::Transforms& tractions)
    : wavenumber_(wavenumber) {
  for (std::size_t i = 0; i < medium.size(); ++i)
    layers_.push_back({LayerWaves(wavenumber, moduli[i], medium[i], speed), moduli[i], medium[i].thickness,
                       medium[i].poisson_ratio, Matrix2::Zero(), Vector2::Zero()});
  // From the base up: stresses at the upper face per amplitude coming down, over G k.
  std::vector<Matrix2> stress_per_wave(medium.size());
  Matrix2 below = Matrix2::Zero();  // displacement per stress of what lies below
  for (std::size_t i = medium.size(); i-- > 0;) {
    LayerState& layer = layers_[i];
    const complex stiffness = layer.modulus * wavenumber;
    const Waves near = layer.waves.at(0);
    Matrix2 displacements = near.displacements, stresses = near.stresses;
    if (std::isfinite(layer.thickness)) {
      const Waves far = layer.waves.at(layer.thickness), up_far = far.mirrored();
      layer.reflected = reflection(near, far, below * stiffness);
      displacements += up_far.displacements * layer.reflected;
      stresses += up_far.stresses * layer.reflected;
    }
    stress_per_wave[i] = stresses * stiffness;
    below = displacements * inverse(stress_per_wave[i]);
  }
  // On a face with its normal downwards the tractions have the other sign.
  Vector2 stress(-tractions.shear, complex(0, 1) * tractions.pressure);
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    LayerState& layer = layers_[i];
    layer.down = inverse(stress_per_wave[i]) * stress;
    if (std::isinf(layer.thickness)) break;
    const Waves far = layer.waves.at(layer.thickness), up = layer.waves.at(0).mirrored();
    stress = layer.modulus * wavenumber * (far.stresses + up.stresses * layer.reflected) * layer.down;
  }
}

DepthState DepthResponse::at(std::size_t index, double depth) const {
  constexpr complex i{0, 1};
  const LayerState& layer = layers_[index];
  const Waves down = layer.waves.at(depth);
  Vector2 displacement = down.displacements * layer.down, stress = down.stresses * layer.down;
  if (wavenumber_ * (layer.thickness - depth) < vanished) {
    const Waves up = layer.waves.at(layer.thickness - depth).mirrored();
    const Vector2 amplitude = layer.reflected * layer.down;
    displacement += up.displacements * amplitude;
    stress += up.stresses * amplitude;
  }
  const double nu = layer.poisson_ratio;
  const complex stiffness = layer.modulus * wavenumber_, normal = i * stiffness * stress(1);
  // sigma_x from the plane strain along x.
  return {.u = displacement(0),
          .w = -i * displacement(1),
          .stress = {.x = nu / (1 - nu) * normal + 2.0 / (1 - nu) * i * stiffness * displacement(0),
                     .z = normal,
                     .xz = -stiffness * stress(0)}};
}

}  // namespace rollres
