#include "core/surface/layer_waves.hpp"

#include <cmath>

namespace rollres {

using complex = std::complex<double>;
using Matrix2 = Eigen::Matrix2cd;

Waves Waves::mirrored() const {
  Waves other = *this;
  other.displacements.row(1) *= -1;
  other.stresses.row(0) *= -1;
  return other;
}

LayerWaves::LayerWaves(double wavenumber, complex modulus, const MediumLayer& layer, double wave_speed)
    : wavenumber_(wavenumber),
      epsilon_(layer.density * wave_speed * wave_speed / modulus),
      ratio_((1 - 2 * layer.poisson_ratio) / (2 - 2 * layer.poisson_ratio)),
      alpha_(std::sqrt(1.0 - epsilon_ * ratio_)),
      beta_(std::sqrt(1.0 - epsilon_)),
      per_epsilon_(1.0 / (1.0 + beta_) - ratio_ / (1.0 + alpha_)),
      across_(1.0 / (1.0 + beta_)),
      along_(ratio_ / (1.0 + alpha_)) {}

Waves LayerWaves::at(double depth) const {
  const double kz = wavenumber_ * depth;
  Waves waves;
  if (epsilon_ == 0.0) {  // both decay alike
    const double decay = std::exp(-kz), difference = kz * per_epsilon_.real(), ratio = along_.real();
    waves.displacements << decay, decay * (difference - 0.5),  //
        decay, decay * (difference + ratio);
    waves.stresses << -2.0 * decay, decay * (1 - 2 * difference - 2 * ratio),  //
        -2.0 * decay, -2.0 * decay * difference;
    return waves;
  }
  const complex slow = std::exp(-kz * alpha_), fast = std::exp(-kz * beta_);
  // (e^{-k beta z} - e^{-k alpha z}) / epsilon
  const complex exponent = kz * per_epsilon_ * epsilon_;
  const complex series =
      1.0 + exponent / 2.0 * (1.0 + exponent / 3.0 * (1.0 + exponent / 4.0 * (1.0 + exponent / 5.0)));
  const complex difference =
      std::abs(exponent) < 1e-3 ? complex(slow * kz * per_epsilon_ * series) : complex((fast - slow) / epsilon_);
  waves.displacements << slow, difference - across_ * fast,  //
      alpha_ * slow, difference + along_ * slow;
  waves.stresses << -2.0 * alpha_ * slow, fast - 2.0 * difference - 2.0 * along_ * slow,  //
      (epsilon_ - 2.0) * slow, 2.0 * across_ * fast - 2.0 * difference - slow;
  return waves;
}

Matrix2 inverse(const Matrix2& m) {
  Matrix2 adjugate;
  adjugate << m(1, 1), -m(0, 1), -m(1, 0), m(0, 0);
  return adjugate / (m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0));
}

Matrix2 reflection(const Waves& near, const Waves& far, const Matrix2& yielding) {
  const Waves up = near.mirrored();
  return -inverse(Matrix2(up.displacements - yielding * up.stresses)) * (far.displacements - yielding * far.stresses);
}

}  // namespace rollres
