#pragma once

/// Root of a continuous function of one variable between two points.

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "core/numerics/solution_limits.hpp"

namespace rollres {

/// x in [low, high] with function(x) = 0, in a bracket of at most twice `tolerance`, relatively; nothing where
/// function(low) and function(high) have the same sign or are no numbers, or an end is not finite. False position after
/// Illinois (Dowell and Jarratt 1971, BIT 11, 168), with a bisection whenever three steps have not halved the bracket,
/// and no step closer to an end than the tolerance (Brent 1973, chapter 4): an end where the function is tiny is no
/// root because steps stay beside it. Convergence is fast for a smooth function and certain for any.
template <class Function>
std::optional<double> root_between(Function function, double low, double high, double tolerance = 2e-16) {
  double f_low = function(low), f_high = function(high);
  if (f_low == 0) return low;
  if (f_high == 0) return high;
  if (std::isnan(f_low) || std::isnan(f_high) || std::signbit(f_low) == std::signbit(f_high)) return {};
  if (!std::isfinite(high - low)) return {};
  double size_low = std::abs(f_low), size_high = std::abs(f_high);  // of the function; the steps' own are halved
  double last_width = std::abs(high - low);
  const double direction = high > low ? 1 : -1;
  int kept = 0;  // side whose end the last step kept: -1 low, 1 high
  for (int step = 1; step <= 400; ++step) {
    require_time();
    const double first = low + direction * tolerance * std::abs(low);
    const double last = high - direction * tolerance * std::abs(high);
    if (!(direction * (last - first) > 0)) break;
    double x = (low * f_high - high * f_low) / (f_high - f_low);
    const double middle = low + (high - low) / 2;
    if (step % 3 == 0) {
      const double width = std::abs(high - low);
      if (width > last_width / 2) x = middle;
      last_width = width;
    }
    if (std::isnan(x)) x = middle;
    x = direction > 0 ? std::clamp(x, first, last) : std::clamp(x, last, first);
    const double f = function(x);
    if (f == 0) return x;
    if (std::signbit(f) == std::signbit(f_low)) {
      low = x, f_low = f, size_low = std::abs(f);
      if (kept == 1) f_high /= 2;
      kept = 1;
    } else {
      high = x, f_high = f, size_high = std::abs(f);
      if (kept == -1) f_low /= 2;
      kept = -1;
    }
  }
  return size_low < size_high ? low : high;
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
