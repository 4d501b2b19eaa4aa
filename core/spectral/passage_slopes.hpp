#pragma once

/// Slopes of any layered surface under a line force in steady passage, as corrections to those of a half-space.
///
/// A ring's curvature goes with ln|x| in them (ring_curvature.hpp).
/// Fourier integrals of the surface's compliance at the frequencies of the passage over that of the half-spaces next to
/// the contact, for their means over a memory as well (core/spectral/README.md, (S24); fourier_table.hpp).

#include <complex>
#include <span>
#include <vector>

#include "core/spectral/slope_correction.hpp"
#include "core/surface/fourier_table.hpp"
#include "core/surface/ring_curvature.hpp"
#include "core/surface/steady_surface.hpp"

namespace rollres {

class PassageSlopes final : public SlopeCorrection {
 public:
  /// @param deep D, the spectrum by which the problem turns elastic slopes into slopes, with the memory lengths V time
  /// of its terms in their order
  /// @param surface whose memories are joined as those of D are: where the layers are at rest, the quotient by D must
  /// be that of the half-spaces, down to the longest waves
  /// @param depth over which the layers' part fades: that of the nearest face, less where inertia slows the decay [m]
  /// @param rigid_base whether one lies below all layers: over a half-space there are no displacements
  /// @param sheared whether the hoop's part is wanted of a ring
  PassageSlopes(SteadySurface surface, const CreepSpectrum& deep, double depth, bool rigid_base, bool sheared = true);

  PassageSlopes(const PassageSlopes&) = delete;
  PassageSlopes& operator=(const PassageSlopes&) = delete;

  LayerSlopes slope(double x) const override;
  LayerSlopes memory(std::size_t term, double x) const override;
  LayerSlopes displacement(double x) const override;
  double depth() const override { return depth_; }
  double reach() const override { return INFINITY; }
  RingLogarithms logarithms(double finest) const override;
  RingLogarithms memory_logarithms(std::size_t term, double finest) const override;

 private:
  static constexpr std::size_t slopes_ = 0, displacements_ = 1, first_memory_ = 2;
  void transform(double wavenumber, std::span<std::complex<double>> values) const;

  SteadySurface surface_;
  CreepSpectrum deep_;
  std::vector<double> memory_lengths_;  // over the depth
  double depth_;                        // [m]
  Eigen::Array2d at_rest_;              // 2 k c_ww/D and 2 k c_ll/D of the half-spaces under long waves [1]
  bool rigid_base_;
  /// Over D, of a ring's short waves under pressure and under shear, taken out of the transforms; the same by memory.
  RingCurvature pressed_, sheared_;
  std::vector<RingCurvature> pressed_memory_, sheared_memory_;
  FourierTable table_;
};

}  // namespace rollres
