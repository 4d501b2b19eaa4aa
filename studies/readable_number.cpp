#include "studies/readable_number.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace rollres {

namespace {

std::string rounded(double value) {
  std::array<char, 40> digits;
  const auto written =
      std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::general, 5);
  return {digits.data(), written.ptr};
}

struct Prefix {
  std::string_view text;
  int exponent;
};

/// The prefixes in use before a unit; metres and seconds only go down.
struct Scale {
  int power;  ///< of the first symbol: 2 for "m2"
  bool upwards;
};

/// Empty power (0) if the unit takes no prefix.
Scale scale_of(std::string_view unit) {
  const std::string_view symbol = unit.substr(0, unit.find_first_of("./0123456789"));
  const std::string_view rest = unit.substr(symbol.size());
  if (symbol == "m" || symbol == "s") {
    if (rest == "2") return {2, false};
    if (rest.empty() || rest.front() == '/') return {1, false};
    return {0, false};
  }
  const bool takes = symbol == "N" || symbol == "Pa" || symbol == "W" || symbol == "J";
  return {takes && (rest.empty() || rest.front() == '/' || rest.front() == '.') ? 1 : 0, true};
}

}  // namespace

std::string shortest(double value) {
  std::array<char, 40> digits;
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
}

std::string readable(double value, std::string_view unit) {
  constexpr std::array<Prefix, 7> prefixes{{{"n", -9}, {"µ", -6}, {"m", -3}, {"", 0}, {"k", 3}, {"M", 6}, {"G", 9}}};
  if (std::isnan(value)) return "-";
  if (std::isinf(value)) return value > 0 ? "infinite" : "-infinite";
  if (unit.empty() || unit == "1") return rounded(value);
  const Scale scale = scale_of(unit);
  Prefix best{"", 0};
  if (value != 0 && scale.power > 0) {
    best = prefixes.front();
    constexpr double almost = 0.999995;  // what five digits round up to 1
    for (const Prefix& prefix : prefixes)
      if (std::abs(value) >= almost * std::pow(10.0, prefix.exponent * scale.power) &&
          (scale.upwards || prefix.exponent <= 0))
        best = prefix;
  }
  const double scaled = value * std::pow(10.0, -best.exponent * scale.power);
  return rounded(scaled) + ' ' + std::string(best.text) + std::string(unit);
}

std::size_t width(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0) != 0x80; }));
}

std::string padded(std::string_view text, std::size_t columns) {
  const std::size_t letters = width(text);
  return std::string(text) + std::string(letters < columns ? columns - letters : 0, ' ');
}

}  // namespace rollres
