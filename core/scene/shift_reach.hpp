#pragma once

/// How far a table of shifts reaches: beyond its first and last rows by half the step there and by 1 K at most, as
/// instruments miss the temperature that they are set to.

#include <algorithm>
#include <utility>

namespace rollres {

/// The lowest and the highest temperature [K]. @param first..last  rows of a table in order, of two at least
inline std::pair<double, double> reach_of_shifts(double first, double second, double before_last, double last) {
  constexpr double farthest = 1, share = 0.5;  // [K], of a step
  constexpr double rounding = 1e-12;           // degrees Celsius are turned into kelvins
  return {(first - std::min(farthest, share * (second - first))) * (1 - rounding),
          (last + std::min(farthest, share * (last - before_last))) * (1 + rounding)};
}

}  // namespace rollres
