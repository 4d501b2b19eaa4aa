#include "studies/scaled_unit.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace rollres {

namespace {

struct Prefix {
  std::string_view name;
  int thousands;  // factor = 1000^thousands
};
constexpr std::array<Prefix, 7> prefixes{{{"n", -3}, {"µ", -2}, {"m", -1}, {"", 0}, {"k", 1}, {"M", 2}, {"G", 3}}};

/// Which prefixes a unit takes in this field, by its first symbol.
struct Prefixed {
  std::string_view symbol;
  int lowest, highest;  // powers of 1000
};
constexpr std::array<Prefixed, 5> prefixed{{{"m", -3, 0}, {"N", -2, 3}, {"Pa", 0, 3}, {"s", -3, 0}, {"W", -2, 3}}};

/// "N.m/s" starts with "N".
std::string_view first_symbol(std::string_view unit) { return unit.substr(0, unit.find_first_of("./0123456789")); }

/// Power to which the first symbol stands: 2 for "m2".
int first_power(std::string_view unit) {
  const std::size_t place = first_symbol(unit).size();
  return place > 0 && place < unit.size() && unit[place] >= '2' && unit[place] <= '9' ? unit[place] - '0' : 1;
}

/// "kg/m3" as "kg/m³", "N.m" as "N·m".
std::string typeset(std::string_view unit) {
  std::string text;
  for (const char letter : unit) {
    if (letter == '2')
      text += "²";
    else if (letter == '3')
      text += "³";
    else if (letter == '.')
      text += "·";
    else
      text += letter;
  }
  return text;
}

const Prefixed* prefixed_unit(std::string_view unit) {
  const auto* const found = std::find_if(prefixed.begin(), prefixed.end(),
                                         [&](const Prefixed& known) { return known.symbol == first_symbol(unit); });
  return found == prefixed.end() ? nullptr : found;
}

ScaledUnit with_prefix(std::string_view unit, int thousands) {
  const auto* const prefix =
      std::find_if(prefixes.begin(), prefixes.end(), [&](const Prefix& known) { return known.thousands == thousands; });
  return {std::string(prefix->name) + typeset(unit), std::pow(1000.0, thousands * first_power(unit))};
}

}  // namespace

ScaledUnit scaled_unit(std::string_view unit, double largest) {
  if (unit == "1" || unit.empty()) return {};
  const Prefixed* const known = prefixed_unit(unit);
  largest = std::abs(largest);
  if (!known || largest == 0 || !std::isfinite(largest)) return {typeset(unit), 1.0};
  // Six digits are shown at most: 999.9999 is 1000 to the reader.
  const double decades = std::log10(largest * (1 + 1e-6)) / (3.0 * first_power(unit));
  const int thousands = std::clamp(static_cast<int>(std::floor(decades)), known->lowest, known->highest);
  return with_prefix(unit, thousands);
}

ScaledUnit scaled_unit_logarithmic(std::string_view unit, double smallest, double largest) {
  if (!(smallest > 0) || !std::isfinite(largest)) return scaled_unit(unit, largest);
  if (unit == "1" || unit.empty()) return {};
  const Prefixed* const known = prefixed_unit(unit);
  constexpr double thousand = 1000.0 * (1 + 1e-6);
  if (!known || (smallest * thousand >= 1 && largest <= thousand)) return {typeset(unit), 1.0};
  const double centre = 0.5 * (std::log10(smallest) + std::log10(largest)) / (3.0 * first_power(unit));
  return with_prefix(unit, std::clamp(static_cast<int>(std::lround(centre)), known->lowest, known->highest));
}

std::string short_number(double value, int digits) {
  if (std::isnan(value)) return "NaN";
  if (std::isinf(value)) return value > 0 ? "infinite" : "-infinite";
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

std::string with_scaled_unit(double value, std::string_view unit, int digits) {
  if (!std::isfinite(value)) return short_number(value);
  const ScaledUnit scaled = scaled_unit(unit, value);
  const std::string number = short_number(value / scaled.factor, digits);
  return scaled.name.empty() ? number : number + " " + scaled.name;
}

}  // namespace rollres
