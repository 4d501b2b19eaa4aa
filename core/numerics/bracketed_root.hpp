#pragma once

/// Root of a continuous function of one variable between two points.

#include <cmath>
#include <stdexcept>

#include "core/numerics/solution_limits.hpp"

namespace rollres {

/// x in [low, high] with function(x) = 0, until a step changes it by less than `tolerance`, relatively; function(low)
/// and function(high) must not have the same sign. False position after Illinois (Dowell and Jarratt 1971, BIT 11,
/// 168), with a bisection whenever three steps have not halved the bracket: convergence is fast for a smooth function
/// and certain for any.
/// @throws std::domain_error if they have, or are no numbers
template <class Function>
double bracketed_root(Function function, double low, double high, double tolerance = 2e-16) {
  double f_low = function(low), f_high = function(high);
  if (f_low == 0) return low;
  if (f_high == 0) return high;
  if (std::isnan(f_low) || std::isnan(f_high) || std::signbit(f_low) == std::signbit(f_high))
    throw std::domain_error("no root found between two points: the numbers given are too far apart");
  double best = low, last_width = std::abs(high - low);
  int kept = 0;  // side whose end the last step kept: -1 low, 1 high
  for (int step = 1; step <= 400; ++step) {
    require_time();
    double x = (low * f_high - high * f_low) / (f_high - f_low);
    const double middle = low + (high - low) / 2;
    if (step % 3 == 0) {
      const double width = std::abs(high - low);
      if (width > last_width / 2) x = middle;
      last_width = width;
    }
    if (!(x > low && x < high) && !(x < low && x > high)) x = middle;
    const double f = function(x);
    const bool settled = std::abs(x - best) <= tolerance * std::abs(x);
    best = x;
    if (f == 0 || settled) break;
    if (std::signbit(f) == std::signbit(f_low)) {
      low = x, f_low = f;
      if (kept == 1) f_high /= 2;
      kept = 1;
    } else {
      high = x, f_high = f;
      if (kept == -1) f_low /= 2;
      kept = -1;
    }
  }
  return best;
}

}  // namespace rollres
