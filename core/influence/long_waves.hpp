#pragma once

/// What the cells of a grid make of waves much longer than a cell under pressure (core/influence/README.md, (K16)).
///
/// A pressure that is uniform over each cell has steps, whose short waves move the nodes, too. Under a long wave that
/// is little beside the wave's own displacement, but for a thin layer that keeps its volume: it yields like k^2 H^3 to
/// long waves, and like 1/k to those of a cell of about its thickness, at which a load comes out a tenth too small.

#include <complex>

#include "core/influence/influence.hpp"
#include "core/surface/steady_surface.hpp"

namespace rollres {

/// Changes coefficients of neighbours so that long waves are met to the second order in the wavenumber; less, and not
/// at all, where cells make less than a hundredth, and a thousandth, of a wave of ten cells a radian.
class LongWaveCorrection {
 public:
  /// @param backwards whether the surface, of a coating alone, flows against the motion
  LongWaveCorrection(const SteadySurface& surface, const SurfaceGrid& grid, bool backwards = false);

  void add_to(InfluenceTable& table) const;
  /// What was mended of the displacement in phase under a wave of ten cells a radian along the motion, over all of it,
  /// by this surface and by another beside it [1]. What lags of the former is that of memories shorter than a cell, of
  /// which (N21) in core/newton/README.md tells.
  double share() const { return mended_ == 0 ? 0 : std::abs(mended_ / whole_); }
  double share_with(const LongWaveCorrection& other) const {
    const double mended = mended_ + other.mended_;
    return mended == 0 ? 0 : std::abs(mended / (whole_ + other.whole_));
  }

 private:
  double ahead_ = 0, behind_ = 0, aside_ = 0;  // of the neighbours at +x, -x and +-y
  double mended_ = 0;
  std::complex<double> whole_;
};

}  // namespace rollres
