#pragma once

/// Wavenumbers for transforms of what a layer adds to its half-space: smooth from 0 to where it has vanished.

#include <vector>

namespace rollres {

/// At a distance r a smooth function of k matters up to k ~ 50/r only: beyond, it is faded out by a smooth factor whose
/// transform is below 1e-11 there. Bessel functions of an order oscillate from k ~ order/r only.
struct WavenumberFade {
  double from, to;

  explicit WavenumberFade(double r, int order = 0);
  double operator()(double k) const;
};

/// Nodes k with weights, fade included, for distances from r0 to r1; in any unit of length.
struct WavenumberRule {
  /// @param lowest wavenumber at which anything happens   @param highest that matters
  WavenumberRule(double lowest, double highest, double r0, double r1, int order = 0);

  std::vector<double> nodes, weights;
};

}  // namespace rollres
