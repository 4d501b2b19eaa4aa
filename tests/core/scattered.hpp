#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>

/// Noise that belongs to a number: a normal deviate of deviation 1, always the same for the same number.
inline double scatter(double number, std::uint64_t seed) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &number, sizeof bits);
  const auto uniform = [&bits, seed] {  // splitmix64
    bits += 0x9E3779B97F4A7C15ULL * (2 * seed + 1);
    std::uint64_t mixed = bits;
    mixed = (mixed ^ (mixed >> 30)) * 0xBF58476D1CE4E5B9ULL;
    mixed = (mixed ^ (mixed >> 27)) * 0x94D049BB133111EBULL;
    return (static_cast<double>((mixed ^ (mixed >> 31)) >> 11) + 0.5) * 0x1p-53;
  };
  const double radius = std::sqrt(-2 * std::log(uniform()));
  return radius * std::cos(2 * 3.141592653589793 * uniform());
}
