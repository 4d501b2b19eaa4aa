#pragma once

/// The compliance of a layered medium as a sum over fixed retardation times, wavenumber by wavenumber:
///   c(k, omega) ~ sum_m c_m(k) / (1 + i omega tau_m),      tau_0 = 0      (core/influence/README.md, (K10)).
/// Layers of different materials do not share a spectrum: at each wavenumber the medium relaxes in its own way. Its
/// times lie between the shortest relaxation time and the longest creep time of its layers, where a few tau_m a decade
/// and the creep times themselves leave an error that is measured. The weights are real and found by least squares over
/// frequencies, so that a steady passage is again a sum of elastic responses with exponential memories
/// (passage_kernel.hpp).

#include <Eigen/Core>
#include <vector>

#include "core/surface/layered_medium.hpp"

namespace rollres {

/// One retardation time and what it weighs in the half-spaces that the medium resembles under short and long waves.
struct MediumTerm {
  double time;        ///< tau_m [s]; 0: instantaneous
  LayerSymbols deep;  ///< k c_m(k) as k -> infinity: the top layer [1/Pa]
  LayerSymbols base;  ///< as k -> 0: the half-space below, or 0 over a rigid base [1/Pa]
};

class MediumExpansion {
 public:
  /// @param wave_speed V cos, for the inertia [m/s]; 0: without
  /// @param per_decade times to begin with; more, up to `most_per_decade`, while the error is beyond `wanted_error`
  MediumExpansion(const LayeredMedium& medium, double wave_speed, double per_decade = 5);
  /// For slower waves of the same medium, at the times and in the range of wavenumbers of another expansion.
  MediumExpansion(const LayeredMedium& medium, double wave_speed, const MediumExpansion& of_faster);

  const std::vector<MediumTerm>& terms() const { return terms_; }

  /// k c_m(k) less its part of the top layer's half-space, term by term [1/Pa]: normal, longitudinal, transverse,
  /// cross.
  using Corrections = Eigen::Array<double, 4, Eigen::Dynamic>;
  Corrections correction(double wavenumber) const;

  static constexpr double wanted_error = 1e-5, most_per_decade = 9, denser = 2;
  /// Times a decade that it ended with.
  double per_decade() const { return per_decade_; }

  /// Largest error of the sum over the compliance, at frequencies and wavenumbers between those it was made from [1].
  double error() const { return error_; }

  /// Where corrections begin to tell from the base, and have fallen to e^{-36} [1/m].
  double lowest_wavenumber() const { return lowest_; }
  double highest_wavenumber() const { return highest_; }
  /// Scale of the corrections: the thickness of the top layer times beta (layered_medium.hpp) at rest [m].
  double finest_length() const { return decayed / highest_; }

 private:
  void fit(const LayeredMedium& medium, double wave_speed, const std::vector<double>& times);
  double measured_error(const LayeredMedium& medium, double wave_speed) const;

  static constexpr double decayed = 18;  // e^{-2 * 18} is nothing

  std::vector<MediumTerm> terms_;
  double lowest_ = 0, highest_ = 0, error_ = 0, per_decade_ = 0;
  std::vector<double> borders_;            // of panels in ln k
  std::vector<Corrections> coefficients_;  // Chebyshev, panel by panel
};

}  // namespace rollres
