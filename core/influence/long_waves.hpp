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
  /// @param backwards whether the surface flows backwards, as it is not told of
  LongWaveCorrection(const SteadySurface& surface, const SurfaceGrid& grid, bool backwards = false);

  void add_to(InfluenceTable& table) const;
  /// Displacement in phase that was mended, and all of it, under a wave of ten cells a radian along the motion [m/Pa].
  /// What lags of the former is that of memories shorter than a cell, of which (N21) in core/newton/README.md tells.
  double mended() const { return mended_; }
  std::complex<double> whole() const { return whole_; }

 private:
  double ahead_ = 0, behind_ = 0, aside_ = 0;  // of the neighbours at +x, -x and +-y
  double mended_ = 0;
  std::complex<double> whole_;
};

}  // namespace rollres
