#pragma once

/// The products of tractions and influence coefficients, wavenumber by wavenumber.

#include "core/convolution/padded_convolution.hpp"

namespace rollres {

/// Transforms of the coefficients; replaces (p, tau_y, tau_x) of a block, its even, odd and second fields, by
///   w = -ww p - wx tau_x - wy tau_y,   v = -yw p + xy tau_x + yy tau_y,   u = -xw p + xx tau_x + xy tau_y.
template <class Real>
struct InfluenceTerms {
  const Spectrum<Real>&ww, &wx, &wy, &xw, &yw, &xx, &xy, &yy;

  /// @param lateral false: without tau_y and v, as for a cylinder
  void multiply(const WavenumberBlock<Real>& block, bool lateral) const;
};

}  // namespace rollres
