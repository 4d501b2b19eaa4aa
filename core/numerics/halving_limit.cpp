#include "core/numerics/halving_limit.hpp"

#include <algorithm>
#include <cmath>

namespace rollres {

namespace {

/// 1 where a change is twice the next one, 0 far from it, smooth between: by the logarithm to the base 2 of their
/// quotient, less 1.
double halves(double change, double next) {
  constexpr double close = 0.15, far = 0.4;
  const double ratio = change / next;
  if (!(ratio > 0) || !std::isfinite(ratio)) return 0;
  const double t = std::clamp((far - std::abs(std::log2(ratio) - 1)) / (far - close), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace

HalvingLimit::HalvingLimit(const std::array<double, 4>& values, double most) {
  const double first = values[1] - values[0], second = values[2] - values[1], third = values[3] - values[2];
  share = most * halves(first, second) * halves(second, third);
  to_come = share * third;
  constexpr double open = 0.25;  // on random scenes up to 0.2 of it was
  error = std::hypot(2 * third - second, open * third);
}

}  // namespace rollres
