#pragma once

/// How far an integral over wavenumbers must go at a distance.

#include <cmath>

namespace rollres {

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

}  // namespace rollres
