#include "studies/text/scaled_unit.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "studies/text/words.hpp"

namespace rollres {

namespace {

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
  const auto* const found = std::find_if(prefixed.begin(), prefixed.end(),
                                         [&](const Prefixed& known) { return known.symbol == first_symbol(unit); });
  return found == prefixed.end() ? nullptr : found;
}

ScaledUnit with_prefix(std::string_view unit, int thousands) {
  const auto* const prefix =
      std::find_if(prefixes.begin(), prefixes.end(), [&](const Prefix& known) { return known.thousands == thousands; });
  return {std::string(prefix->name) + std::string(unit), std::pow(1000.0, thousands * first_power(unit))};
}

}  // namespace

ScaledUnit scaled_unit(std::string_view unit, double size) {
  if (unit == "1" || unit.empty()) return {};
  const Prefixed* const known = prefixed_unit(unit);
  size = std::abs(size);
  if (!known || size == 0 || !std::isfinite(size)) return {std::string(unit), 1.0};
  constexpr double almost = 0.999995;
  const double thousands = std::log10(size / almost) / (3.0 * first_power(unit));
  return with_prefix(unit, std::clamp(static_cast<int>(std::floor(thousands)), known->lowest, known->highest));
}

ScaledUnit scaled_unit_logarithmic(std::string_view unit, double smallest, double largest) {
  if (!(smallest > 0) || !std::isfinite(largest)) return scaled_unit(unit, largest);
  if (unit == "1" || unit.empty()) return {};
  const Prefixed* const known = prefixed_unit(unit);
  constexpr double rounding = 1 + 1e-6;
  if (!known || (smallest * rounding >= 1e-3 && largest <= 1e4 * rounding)) return {std::string(unit), 1.0};
  const double centre = 0.5 * (std::log10(smallest) + std::log10(largest)) / (3.0 * first_power(unit));
  return with_prefix(unit, std::clamp(static_cast<int>(std::lround(centre)), known->lowest, known->highest));
}

std::string typeset_unit(std::string_view unit) { return replaced(unit, {{'2', "²"}, {'3', "³"}, {'.', "·"}}); }

}  // namespace rollres
