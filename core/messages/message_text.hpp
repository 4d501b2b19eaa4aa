#pragma once

/// Texts of messages and notes, with few digits.

#include <array>
#include <charconv>
#include <cmath>
#include <concepts>
#include <numbers>
#include <sstream>
#include <string>
#include <string_view>

namespace rollres {

/// Adds a part to a line, a number to so many digits as by a stream, which takes far longer.
template <int digits, class Part>
void add_part(std::string& line, const Part& part) {
  if constexpr (std::convertible_to<const Part&, std::string_view>) {
    line += std::string_view(part);
  } else if constexpr (std::same_as<Part, char>) {
    line += part;
  } else if constexpr (std::floating_point<Part>) {
    std::array<char, 64> number{};
    line.append(
        number.data(),
        std::to_chars(number.data(), number.data() + number.size(), part, std::chars_format::general, digits).ptr);
  } else if constexpr (std::integral<Part>) {
    line += std::to_string(part);
  } else {
    std::ostringstream text;
    text << part;
    line += text.str();
  }
}

/// The parts one after the other, numbers to so many digits.
template <int digits = 3, class... Parts>
std::string message_text(const Parts&... parts) {
  std::string line;
  (add_part<digits>(line, parts), ...);
  return line;
}

/// A temperature as people read it: "-20 degC". @param temperature [K]
template <int digits = 5>
std::string in_celsius(double temperature) {
  constexpr double rounding = 1e-9;  // [K]
  const double celsius = temperature - 273.15;
  return message_text<digits>(std::abs(celsius) < rounding ? 0 : celsius, " degC");
}

/// An angle as people read it: "1 deg". @param angle [rad]
inline std::string in_degrees(double angle) { return message_text<5>(angle * 180 / std::numbers::pi, " deg"); }

/// One text of all: "speed, load". @param text_of what of each is told
template <class List, class TextOf>
std::string joined(const List& list, std::string_view between, TextOf&& text_of) {
  std::string text;
  for (const auto& one : list) (text += text.empty() ? "" : between) += text_of(one);
  return text;
}
template <class List>
std::string joined(const List& list, std::string_view between = ", ") {
  return joined(list, between, [](const auto& one) { return std::string_view(one); });
}

}  // namespace rollres
