#pragma once

/// Slopes of any layered surface under a line force in steady passage, as corrections to those of a half-space.
///
/// At the wavenumber k along the motion the surface yields by c(k, -k V), and the half-spaces of the materials next to
/// the contact by D(-k V)/(2k), D being the problem's spectrum of creep. The slope is w' = D g; so that the elastic
/// slopes g have the corrections
///     normal(x)     = Re 1/pi int_0^inf i s_ww(k) e^{i k x} dk,      s = (k c - k c_deep)/D,
///     tangential(x) = Re 1/pi int_0^inf i s_ll(k) e^{i k x} dk,
///     cross(x)      = -Re 1/pi int_0^inf s_x(k) e^{i k x} dk,
/// with a factor 1/(1 - i k T) for the mean over a memory T. The symbols s fall off like e^{-2 k depth}; their
/// singularities lie on the imaginary axis (memories) and where the layers have theirs, so that panels of k in constant
/// ratio suit them. Tables over x are made panel by panel, where they are asked for.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/contact_surface.hpp"
#include "core/slope_correction.hpp"

namespace rollres {

class PassageSlopes final : public SlopeCorrection {
 public:
  /// @param deep D, the spectrum by which the problem turns elastic slopes into slopes, with the memory lengths V time
  /// of its terms in their order
  PassageSlopes(const RollingScene& scene, const CreepSpectrum& deep);

  LayerSlopes slope(double x) const override { return value(slopes_, x) / depth_; }
  LayerSlopes memory(std::size_t term, double x) const override { return value(first_memory_ + term, x) / depth_; }
  LayerSlopes displacement(double x) const override;
  double depth() const override { return depth_; }
  double reach() const override { return INFINITY; }

 private:
  static constexpr std::size_t slopes_ = 0, displacements_ = 1, first_memory_ = 2;
  /// Chebyshev coefficients of all functions on the panel of distances over the depth and on its mirror image.
  struct PanelPair {
    std::array<std::vector<LayerSlopes>, 2> coefficients;  // ahead, behind; [function, term]
  };
  struct WaveRule;

  /// @return in units of 1/depth
  LayerSlopes value(std::size_t function, double x) const;
  WaveRule wave_rule(double from, double to) const;
  PanelPair made(double from, double to) const;

  SteadySurface surface_;
  CreepSpectrum deep_;
  std::vector<double> memory_lengths_;  // over the depth
  double depth_, longest_wave_;         // [m]
  bool rigid_base_;
  mutable std::vector<double> borders_{0, 1.2};  // of panels, over the depth
  mutable std::vector<PanelPair> panels_;        // empty ones are not made yet
};

}  // namespace rollres
