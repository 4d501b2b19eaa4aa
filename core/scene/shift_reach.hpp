#pragma once

/// How far a table of shifts reaches: beyond its first and last rows by half the step there and by 1 K at most, as
/// instruments miss the temperature that they are set to.

#include <algorithm>
#include <utility>
#include <vector>

namespace rollres {

/// The lowest and the highest temperature [K]. @param temperatures  one at least, in any order
inline std::pair<double, double> reach_of_shifts(std::vector<double> temperatures) {
  std::sort(temperatures.begin(), temperatures.end());
  constexpr double farthest = 1, share = 0.5;  // [K], of a step
  constexpr double rounding = 1e-12;           // degrees Celsius are turned into kelvins
  const std::size_t last = temperatures.size() - 1;
  const double below = last == 0 ? 0 : std::min(farthest, share * (temperatures[1] - temperatures[0]));
  const double above = last == 0 ? 0 : std::min(farthest, share * (temperatures[last] - temperatures[last - 1]));
  return {(temperatures.front() - below) * (1 - rounding), (temperatures.back() + above) * (1 + rounding)};
}

}  // namespace rollres
