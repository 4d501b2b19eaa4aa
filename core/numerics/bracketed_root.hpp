#pragma once

/// Root of a continuous function of one variable between two points.

#include <cmath>
#include <optional>
#include <stdexcept>

#include "core/numerics/solution_limits.hpp"

namespace rollres {

/// x in [low, high] with function(x) = 0, until a step changes it by less than `tolerance`, relatively; nothing where
/// function(low) and function(high) have the same sign or are no numbers. False position after Illinois (Dowell and
/// Jarratt 1971, BIT 11, 168), with a bisection whenever three steps have not halved the bracket: convergence is fast
/// for a smooth function and certain for any.
template <class Function>
std::optional<double> root_between(Function function, double low, double high, double tolerance = 2e-16) {
  double f_low = function(low), f_high = function(high);
  if (f_low == 0) return low;
  if (f_high == 0) return high;
  if (std::isnan(f_low) || std::isnan(f_high) || std::signbit(f_low) == std::signbit(f_high)) return {};
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

/// The same, of a function that is known to change its sign: where a scene decides whether it does, ask `root_between`
/// and say what was not found.
/// @throws std::domain_error if it does not
template <class Function>
double bracketed_root(Function function, double low, double high, double tolerance = 2e-16) {
  if (const std::optional<double> root = root_between(function, low, high, tolerance)) return *root;
  throw std::domain_error("a function that must change its sign does not: a fault of this program");
}

}  // namespace rollres
