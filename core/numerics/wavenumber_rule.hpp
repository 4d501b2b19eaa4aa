#pragma once

/// Wavenumbers for transforms of what a layer adds to its half-space: smooth from 0 to where it has vanished.

#include <cmath>
#include <vector>

namespace rollres {

/// Distances over the length where panels of tables end, the last one beyond `end`: the functions are singular at
/// distances of +-2i and more only, so that panels may widen.
std::vector<double> distance_panels(double end);

/// At a distance r a function of k that is smooth relative to k matters up to k ~ 80/r only: beyond, it is faded out by
/// a smooth factor whose transform is there below e^{-(80/14)^2} = 1e-14. Bessel functions of an order begin to
/// oscillate at k ~ order/r.
struct WavenumberFade {
  double from, to;  // [1/m], or any other unit, as the distance

  explicit WavenumberFade(double r, int order = 0) : from(r > 0 ? (80 + 2 * order) / r : INFINITY), to(3 * from) {}
  double operator()(double k) const {
    return std::isinf(from) ? 1 : 0.5 * std::erfc(7 * (2 * (k - from) / (to - from) - 1));
  }
};

/// Nodes k with weights, fade included, for distances from r0 to r1; in any unit of length.
struct WavenumberRule {
  /// @param lowest wavenumber at which anything happens   @param highest that matters
  WavenumberRule(double lowest, double highest, double r0, double r1, int order = 0);

  std::vector<double> nodes, weights;
};

}  // namespace rollres
