#include "studies/text/readable_number.hpp"
#include "studies/text/value_and_error.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "studies/text/words.hpp"

namespace rollres {

std::string shortest(double value) {
  std::array<char, 40> digits;
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
}

std::string short_number(double value, int digits) {
  if (!std::isfinite(value)) return shortest(value);
  value = to_digits(value, digits);
  std::array<char, 40> text;
  char* const end = text.data() + text.size();
  const double size = std::abs(value);
  const bool plain = size == 0 || (size >= 1e-5 && size < 1e7);
  const auto written =
      std::to_chars(text.data(), end, value, plain ? std::chars_format::fixed : std::chars_format::scientific);
  return {text.data(), written.ptr};
}

std::string to_the_second(const std::string& time) {
  return time.size() < 19 ? time : time.substr(0, 10) + " " + time.substr(11, 8);
}

std::string percent(double part, int digits) {
  return std::isfinite(part) ? short_number(100 * part, digits) + " %" : "-";
}

std::string readable(double value, std::string_view unit) {
  if (std::isnan(value)) return "-";
  if (std::isinf(value)) return value > 0 ? "infinite" : "-infinite";
  const ScaledUnit scaled = scaled_unit(unit, value);
  const std::string number = short_number(scaled.number(value), shown_digits);
  return scaled.name.empty() ? number : number + ' ' + scaled.name;
}

std::string readable(const Quantity& quantity, double value, std::string_view unit) {
  if (!std::isfinite(value) || unit != "K" || !is_temperature(quantity.key)) return readable(value, unit);
  return short_number(celsius().number(value), shown_digits) + ' ' + celsius().name;
}

ValueAndError value_and_error(double value, double error, std::string_view unit) {
  if (!std::isfinite(value) || !std::isfinite(error) || !(error > 0))
    return {readable(value, unit), readable(error, unit)};
  const ScaledUnit scaled = scaled_unit(unit, value == 0 ? error : value);
  const double size = std::abs(value / scaled.factor), rounded = to_digits(error / scaled.factor, 2);
  const double last = std::pow(10.0, std::floor(std::log10(rounded)) - 1);  // worth of the error's last digit
  const auto digits =
      size < last ? 1.0 : std::clamp<double>(std::floor(std::log10(size / last) + 1e-9) + 1, 1, shown_digits);
  const double shown = size < last ? std::round(value / scaled.factor / last) * last : value / scaled.factor;
  const auto with_unit = [&](const std::string& number) {
    return scaled.name.empty() ? number : number + ' ' + scaled.name;
  };
  return {with_unit(short_number(shown, static_cast<int>(digits))), with_unit(short_number(rounded, 2))};
}

double to_digits(double value, int digits) {
  if (!std::isfinite(value)) return value;
  std::array<char, 40> text;
  char* const end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::scientific, digits - 1).ptr;
  std::from_chars(text.data(), end, value);
  return value;
}

ScaledUnit celsius() { return {"°C", 1.0, 273.15}; }

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

namespace {

ScaledUnit degrees() { return {"°", M_PI / 180}; }

struct Prefix {
  std::string_view name;
  int thousands;  // factor = 1000^thousands
};
constexpr std::array<Prefix, 7> prefixes{{{"n", -3}, {"µ", -2}, {"m", -1}, {"", 0}, {"k", 1}, {"M", 2}, {"G", 3}}};

/// Units that take a prefix, by their first symbol.
struct Prefixed {
  std::string_view symbol;
  int lowest, highest;  // powers of 1000
};
constexpr std::array<Prefixed, 6> prefixed{
    {{"m", -3, 0}, {"s", -3, 0}, {"N", -3, 3}, {"Pa", -3, 3}, {"W", -3, 3}, {"J", -3, 3}}};

/// "N.m/s" starts with "N".
std::string_view first_symbol(std::string_view unit) { return unit.substr(0, unit.find_first_of("./0123456789")); }

/// Power to which the first symbol stands: 2 for "m2".
int first_power(std::string_view unit) {
  const std::size_t place = first_symbol(unit).size();
  return place > 0 && place < unit.size() && unit[place] >= '2' && unit[place] <= '9' ? unit[place] - '0' : 1;
}

const Prefixed* prefixed_unit(std::string_view unit) {
  const auto* const found =
      find_if(prefixed, [&](const Prefixed& known) { return known.symbol == first_symbol(unit); });
  return found == prefixed.end() ? nullptr : found;
}

ScaledUnit with_prefix(std::string_view unit, int thousands) {
  const auto* const prefix = find_if(prefixes, [&](const Prefix& known) { return known.thousands == thousands; });
  return {std::string(prefix->name) + std::string(unit), std::pow(1000.0, thousands * first_power(unit))};
}

}  // namespace

ScaledUnit scaled_unit(std::string_view unit, double size) {
  if (unit == "1" || unit.empty()) return {};
  if (unit == "rad") return degrees();
  const Prefixed* const known = prefixed_unit(unit);
  size = std::abs(size);
  if (!known || size == 0 || !std::isfinite(size)) return {std::string(unit), 1.0};
  constexpr double almost = 0.999995;
  const double thousands = std::log10(size / almost) / (3.0 * first_power(unit));
  return with_prefix(unit, std::clamp(static_cast<int>(std::floor(thousands)), known->lowest, known->highest));
}

ScaledUnit scaled_unit_logarithmic(std::string_view unit, double smallest, double largest) {
  const Prefixed* const known = prefixed_unit(unit);
  if (!known || !(smallest > 0) || !std::isfinite(largest)) return scaled_unit(unit, largest);
  constexpr double rounding = 1 + 1e-6, most = 1e4;
  if ((largest * rounding >= 1 && largest <= most * rounding)) return {std::string(unit), 1.0};
  if (largest < 1) return scaled_unit(unit, largest * rounding);
  const double centre = 0.5 * (std::log10(smallest) + std::log10(largest)) / (3.0 * first_power(unit));
  return with_prefix(unit, std::clamp(static_cast<int>(std::lround(centre)), known->lowest, known->highest));
}

std::string typeset_unit(std::string_view unit) { return replaced(unit, {{'2', "²"}, {'3', "³"}, {'.', "·"}}); }

}  // namespace rollres
