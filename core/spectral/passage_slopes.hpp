#pragma once

/// Slopes of any layered surface under a line force in steady passage, as corrections to those of a half-space.
///
/// At the wavenumber k along the motion the surface yields by c(k, -k V), and the half-spaces of the materials next to
/// the contact by D(-k V)/(2k), D being the problem's spectrum of creep. The slope is w' = D g; so that the elastic
/// slopes g have the corrections
///     normal(x)     = Re 1/pi int_0^inf i s_ww(k) e^{i k x} dk,      s = (k c - k c_deep)/D,
///     tangential(x) = Re 1/pi int_0^inf i s_ll(k) e^{i k x} dk,
///     cross(x)      = -Re 1/pi int_0^inf s_x(k) e^{i k x} dk,
/// with a factor 1/(1 - i k T) for the mean over a memory T (wave_table.hpp).

#include <complex>
#include <span>
#include <vector>

#include "core/spectral/slope_correction.hpp"
#include "core/surface/contact_surface.hpp"
#include "core/surface/wave_table.hpp"

namespace rollres {

class PassageSlopes final : public SlopeCorrection {
 public:
  /// @param deep D, the spectrum by which the problem turns elastic slopes into slopes, with the memory lengths V time
  /// of its terms in their order
  PassageSlopes(const RollingScene& scene, const CreepSpectrum& deep);

  PassageSlopes(const PassageSlopes&) = delete;
  PassageSlopes& operator=(const PassageSlopes&) = delete;

  LayerSlopes slope(double x) const override { return table_(slopes_, x / depth_) / depth_; }
  LayerSlopes memory(std::size_t term, double x) const override {
    return table_(first_memory_ + term, x / depth_) / depth_;
  }
  LayerSlopes displacement(double x) const override;
  double depth() const override { return depth_; }
  double reach() const override { return INFINITY; }

 private:
  static constexpr std::size_t slopes_ = 0, displacements_ = 1, first_memory_ = 2;
  void transform(double wavenumber, std::span<std::complex<double>> values) const;

  SteadySurface surface_;
  CreepSpectrum deep_;
  std::vector<double> memory_lengths_;  // over the depth
  double depth_;                        // [m]
  bool rigid_base_;
  WaveTable table_;
};

}  // namespace rollres
