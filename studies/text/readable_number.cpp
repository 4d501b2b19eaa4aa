#include "studies/text/readable_number.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "studies/text/scaled_unit.hpp"

namespace rollres {

std::string shortest(double value) {
  std::array<char, 40> digits;
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
}

std::string short_number(double value, int digits) {
  if (!std::isfinite(value)) return shortest(value);
  std::array<char, 40> text;
  char* const end = text.data() + text.size();
  const auto rounded = std::to_chars(text.data(), end, value, std::chars_format::scientific, digits - 1);
  std::from_chars(text.data(), rounded.ptr, value);
  const double size = std::abs(value);
  const bool plain = size == 0 || (size >= 1e-5 && size < 1e7);
  const auto written =
      std::to_chars(text.data(), end, value, plain ? std::chars_format::fixed : std::chars_format::scientific);
  return {text.data(), written.ptr};
}

std::string percent(double part, int digits) {
  return std::isfinite(part) ? short_number(100 * part, digits) + " %" : "-";
}

std::string readable(double value, std::string_view unit) {
  if (std::isnan(value)) return "-";
  if (std::isinf(value)) return value > 0 ? "infinite" : "-infinite";
  const ScaledUnit scaled = scaled_unit(unit, value);
  const std::string number = short_number(value / scaled.factor, 5);
  return scaled.name.empty() ? number : number + ' ' + scaled.name;
}

std::string unit_in_brackets(std::string_view unit) {
  return unit.empty() || unit == "1" ? "" : " [" + std::string(unit) + "]";
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
