#include "studies/scene_io/dimension.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <random>

#include "core/scene/solution.hpp"
#include "studies/scene_io/scene_inputs.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

using Exponents = UnitExponents;

struct NamedUnit {
  std::string_view name;
  Exponents exponents;
};

/// What the units of quantities consist of.
constexpr std::array<NamedUnit, 17> symbols{{{"m", {1}},
                                             {"kg", {0, 1}},
                                             {"s", {0, 0, 1}},
                                             {"K", {0, 0, 0, 1}},
                                             {"mol", {0, 0, 0, 0, 1}},
                                             {"EUR", {0, 0, 0, 0, 0, 1}},
                                             {"USD", {0, 0, 0, 0, 0, 0, 1}},
                                             {"GBP", {0, 0, 0, 0, 0, 0, 0, 1}},
                                             {"CHF", {0, 0, 0, 0, 0, 0, 0, 0, 1}},
                                             {"N", {1, 1, -2}},
                                             {"Pa", {-1, 1, -2}},
                                             {"J", {2, 1, -2}},
                                             {"W", {2, 1, -3}},
                                             {"Hz", {0, 0, -1}},
                                             {"rad", {}},
                                             {"byte", {}},
                                             {"1", {}}}};

/// What people call the units of values.
constexpr std::array<std::string_view, 24> usual{"1",    "m",   "m/s",  "N",    "N/m",  "Pa",    "s",    "W",
                                                 "W/m",  "J",   "K",    "kg",   "1/s",  "m2",    "m3",   "kg/m3",
                                                 "m2/s", "1/m", "Pa.s", "Pa/m", "m/s2", "J/mol", "m3/s", "Pa/s"};

/// Of a unit as quantities have it: symbols with a power, "." and "/" between them.
Exponents exponents_of(std::string_view unit) {
  Exponents all{};
  double sign = 1;
  for (std::size_t begin = 0; begin < unit.size();) {
    const std::size_t end = std::min(unit.find_first_of("./", begin), unit.size());
    std::string_view symbol = unit.substr(begin, end - begin);
    double power = 1;
    if (symbol.size() > 1 && symbol.back() >= '2' && symbol.back() <= '9') {
      power = symbol.back() - '0';
      symbol.remove_suffix(1);
    }
    const auto found = find_if(symbols, [&](const NamedUnit& known) { return known.name == symbol; });
    for (std::size_t i = 0; found != symbols.end() && i < all.size(); ++i) all[i] += sign * power * found->exponents[i];
    if (end < unit.size()) sign = unit[end] == '/' ? -1 : 1;
    begin = end + 1;
  }
  return all;
}

std::string name_of_unit(const Exponents& exponents) {
  for (const std::string_view unit : usual)
    if (exponents_of(unit) == exponents) return std::string(unit);
  std::string name;
  for (std::size_t i = 0; i < exponents.size(); ++i)
    if (exponents[i] != 0)
      name += (name.empty() ? "" : ".") + std::string(symbols[i].name) +
              (exponents[i] == 1 ? "" : short_number(exponents[i], 3));
  return name;
}

std::string_view unit_of_key(const std::string& key, Body body) {
  std::string_view unit;
  if (const InputKind* const input = find_input(key)) unit = input->quantity.unit_for(body);
  if (const std::optional<Quantity> output = output_quantity(key)) unit = output->unit_for(body);
  return unit;
}

using Place = std::map<std::string, double>;

constexpr std::size_t near_places = 24, far_places = 24;

/// First places about 1, then such at which a small term beside a large weight becomes the large one.
std::vector<Place> places_for(const Formula& formula) {
  constexpr double near = 4, far = 60;  // widths, in the logarithm
  std::mt19937 random(1);
  std::vector<Place> all;
  while (all.size() < near_places + far_places) {
    const double range = all.size() < near_places ? near : far;
    Place& place = all.emplace_back();
    for (const std::string& key : formula.keys())
      place[key] = std::exp(range * (static_cast<double>(random()) / static_cast<double>(std::mt19937::max()) - 0.5));
  }
  return all;
}

}  // namespace

std::optional<std::string> unit_of_value(const Formula& formula, Body body) {
  constexpr double factor = 1.0001, least_share = 0.25;  // near 1: no comparison turns out otherwise
  std::map<std::string, Exponents> exponents;
  for (const std::string& key : formula.keys()) exponents[key] = exponents_of(unit_of_key(key, body));
  const std::vector<Place> places = places_for(formula);
  Exponents found{};
  for (std::size_t base = 0; base < found.size(); ++base) {
    constexpr std::size_t of_quantities = found.size() - currencies.size();
    const auto has_base = [base](const FormulaConstant& constant) { return constant.exponents[base] != 0; };
    if (base >= of_quantities && none_of(formula.constants(), has_base)) continue;
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    std::size_t valid = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Place& place = places[i];
      const double here = formula([&](const std::string& key) { return place.at(key); });
      std::vector<double> factors;
      for (const FormulaConstant& constant : formula.constants())
        factors.push_back(std::pow(factor, constant.exponents[base]));
      const double there = formula(
          [&](const std::string& key) { return place.at(key) * std::pow(factor, exponents.at(key)[base]); }, factors);
      if (!std::isfinite(here) || !std::isfinite(there) || here == 0) continue;
      if (i < near_places) ++valid;
      if (there / here <= 0) return std::nullopt;
      const double power = std::log(there / here) / std::log(factor);
      lowest = std::min(lowest, power);
      highest = std::max(highest, power);
    }
    if (static_cast<double>(valid) < least_share * static_cast<double>(near_places)) return std::string();
    constexpr double rounding = 1e-7, parts = 12;  // of exponents that are fractions
    if (highest - lowest > rounding) return std::nullopt;
    found[base] = std::round(parts * lowest) / parts;
  }
  return name_of_unit(found);
}

std::string product_of_units(std::string_view one, std::string_view other) {
  if (one == "1" || other == "1") return std::string(one == "1" ? other : one);
  Exponents exponents = exponents_of(one);
  const Exponents more = exponents_of(other);
  std::transform(exponents.begin(), exponents.end(), more.begin(), exponents.begin(), std::plus<>());
  return name_of_unit(exponents);
}

std::string units_in(const Formula& formula, Body body) {
  return joined(formula.keys(), ", ",
                [&](const std::string& key) { return key + unit_in_brackets(unit_of_key(key, body)); });
}

}  // namespace rollres
