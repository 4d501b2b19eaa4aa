#pragma once

/// A layered medium under a load that moves in steady motion, wave vector by wave vector.
///
/// A wave at the angle phi to the motion moves at V cos phi: with inertia the compliance depends on the direction. Each
/// direction has its expansion in retardation times (medium_expansion.hpp), at times common to all, whose weights are
/// real and even, like the response of an elastic surface that is not the same in all directions. The six coefficients
/// are Fourier series of the angle with harmonics of k (core/influence/README.md, (K11)), which converge geometrically
/// below the speed of Rayleigh waves: c has its first singularity where V cos phi, of complex phi, reaches it.

#include <Eigen/Core>
#include <vector>

#include "core/surface/medium_expansion.hpp"

namespace rollres {

/// Fourier coefficients by columns n = 0, 1, ..., of the coefficients in the order of elastic_kernel.hpp by rows.
using Harmonics = Eigen::Array<double, 6, Eigen::Dynamic>;

/// Order of the harmonic n of a coefficient: 2n or 2n + 1.
int order_of_harmonic(Eigen::Index coefficient, int n);

class DirectionalExpansion {
 public:
  /// @param wave_speed V, below that of Rayleigh waves on any of the layers [m/s]; 0: without inertia, where all
  /// directions are the same
  DirectionalExpansion(const LayeredMedium& medium, double wave_speed);

  int harmonics() const { return static_cast<int>(cosines_.size()); }
  int terms() const { return static_cast<int>(fastest().terms().size()); }
  double time(int term) const { return fastest().terms()[static_cast<std::size_t>(term)].time; }  ///< [s]

  /// k c_m as k -> infinity and as k -> 0 [1/Pa].
  Harmonics deep(int term) const { return of_half_space(term, &MediumTerm::deep); }
  Harmonics base(int term) const { return of_half_space(term, &MediumTerm::base); }

  /// k c_m(k) less its deep part [1/Pa]: a column for each term, in which the harmonics stand one after the other.
  Eigen::ArrayXXd correction(double wavenumber) const;

  /// As of MediumExpansion, for all directions, and what the harmonics left out would add.
  double error() const;
  double lowest_wavenumber() const { return fastest().lowest_wavenumber(); }
  double highest_wavenumber() const { return fastest().highest_wavenumber(); }
  double finest_length() const { return fastest().finest_length(); }

 private:
  const MediumExpansion& fastest() const { return expansions_.front(); }
  Harmonics of_half_space(int term, LayerSymbols MediumTerm::*limit) const;

  std::vector<MediumExpansion> expansions_;  // along the motion, then of each direction
  std::vector<double> cosines_;              // of the directions
  std::vector<Harmonics> weights_;           // of each direction in the harmonics
  double left_out_ = 0;
};

}  // namespace rollres
