#pragma once

/// Random numbers that are the same on every machine.

#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

namespace rollres {

/// Four significant digits, the same for two numbers that differ in their last bits.
inline double rounded(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::scientific, 3).ptr;
  double result = 0;
  std::from_chars(text, end, result);
  return result;
}

/// Numbers from the bits of the Mersenne twister, whose sequence the standard fixes (that of its distributions it does
/// not).
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : bits_(seed) {}

  double unit() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }  ///< [0, 1)
  double uniform(double from, double to) { return from + (to - from) * unit(); }
  double log_uniform(double from, double to) { return rounded(from * std::pow(to / from, unit())); }
  int choice(int count) { return static_cast<int>(unit() * count); }
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(unit() * static_cast<double>(count)); }
  bool one_in(double count) { return unit() * count < 1; }
  double signed_log_uniform(double from, double to) {
    const double magnitude = log_uniform(from, to);
    return unit() < 0.5 ? -magnitude : magnitude;
  }

 private:
  std::mt19937_64 bits_;
};

/// Spreads neighbouring numbers over all seeds: the last step of splitmix64 (Steele, Lea and Flood 2014).
inline std::uint64_t mixed(std::uint64_t bits) {
  bits += 0x9e3779b97f4a7c15u;
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
  return bits ^ (bits >> 31);
}

}  // namespace rollres
