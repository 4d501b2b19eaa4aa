#pragma once

/// The waves of one layer at one wavenumber (surface/layered_medium.hpp has their equations).

#include <Eigen/Core>
#include <Eigen/LU>
#include <complex>

#include "core/surface/layered_medium.hpp"

namespace rollres {

/// The two waves that decay downwards, as columns, at some depth below the face they start from: displacements
/// (along, down) [1] and stresses (shear, normal) over G k. What is down or normal is in the field i times that.
struct Waves {
  Eigen::Matrix2cd displacements, stresses;

  /// The same from the other face: down becomes up.
  Waves mirrored() const;
};

/// Waves of one layer of modulus G at wavenumber k.
class LayerWaves {
 public:
  LayerWaves(double wavenumber, std::complex<double> modulus, const MediumLayer& layer, double wave_speed);

  Waves at(double depth) const;

  /// Decay of the wave across: e^{-k beta z}, with stress -G k beta.
  std::complex<double> transverse_decay(double depth) const { return std::exp(-wavenumber_ * depth * beta_); }
  std::complex<double> beta() const { return beta_; }

 private:
  double wavenumber_;
  std::complex<double> epsilon_;
  double ratio_;
  std::complex<double> alpha_, beta_;
  std::complex<double> per_epsilon_, across_, along_;  // 1/(1 + beta) - r/(1 + alpha) and its parts
};

/// The inverse of a matrix of two rows.
Eigen::Matrix2cd inverse(const Eigen::Matrix2cd& m);

/// The waves that go up from the lower face of a layer, per wave that comes down from the upper one, where what lies
/// below has the compliance `yielding`, times G k: displacements (along, down) per stress (shear, normal).
/// @param far the waves from above at the lower face
Eigen::Matrix2cd reflection(const Waves& near, const Waves& far, const Eigen::Matrix2cd& yielding);

}  // namespace rollres
