#include "studies/scene_io/doubtful_number.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/scene/scene_input.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

bool temperature(const Quantity& quantity) {
  return is_temperature(quantity.key) || own_key(quantity.key).starts_with("shift_temperatures");
}

/// Moduli of the material; not stresses, nor the moduli of strain sweeps, of which only ratios count.
bool modulus(std::string_view own) {
  constexpr std::array<std::string_view, 5> keys{"static_shear_modulus", "static_young_modulus", "relaxation_moduli",
                                                 "storage_moduli", "loss_moduli"};
  return find_name(keys, own.substr(0, own.find('['))) >= 0;
}

constexpr double stiff = 1e12;  // [Pa]

/// Of what a number is: stresses of answers are limited in MPa, as moduli are given in it.
enum class Use { input, limit };

/// The unit that was meant instead; empty if the number looks like one in SI.
/// @param unit  of the quantity, for the body
std::string_view meant_unit(const Quantity& quantity, std::string_view unit, double value, Use use) {
  constexpr double long_one = 1, soft = 1e3, cold = 150;  // [m], [Pa], [K]
  if (!std::isfinite(value)) return "";
  if (unit == "m") return value > long_one ? "mm" : "";
  if (temperature(quantity)) return value < cold ? "degC" : "";
  const std::string_view own = own_key(quantity.key);
  if (!modulus(own) && !(use == Use::limit && unit == "Pa")) return "";
  const bool of_series = modulus(own) && own.find('[') != std::string_view::npos;  // as small as one likes
  return value > stiff || (value > 0 && value < soft && !of_series) ? "MPa" : "";
}

bool looks_like_si(const Quantity& quantity, double value) {
  return meant_unit(quantity, quantity.unit, value, Use::input).empty();
}

std::string with_unit(double value, std::string_view unit) { return shortest(value) + " " + std::string(unit); }

/// "did you mean ...?" Of a modulus that is too large, no other unit makes one.
std::string question(double value, std::string_view meant, const std::string& guess) {
  return value > stiff && meant == "MPa" ? "is above 1 TPa." : "did you mean " + guess + "?";
}

/// @param meant  empty if there is no doubt
std::string doubt_in_quotes(std::string_view meant, std::string_view unit, double value) {
  if (meant.empty()) return "";
  return question(value, meant, '"' + with_unit(value, meant) + '"') + " A number without a unit is in " +
         std::string(unit) + ": write \"" + with_unit(value, unit) + "\" if that is meant";
}

}  // namespace

std::string doubt_of(const Quantity& quantity, double value) {
  return doubt_in_quotes(meant_unit(quantity, quantity.unit, value, Use::input), quantity.unit, value);
}

std::string doubt_of_measured(std::string_view unit, double value) {
  return doubt_in_quotes(meant_unit({}, unit, value, Use::limit), unit, value);
}

std::string doubt_of_limit(const Quantity& quantity, std::string_view unit, double value) {
  const std::string_view meant = meant_unit(quantity, unit, value, Use::limit);
  if (meant.empty()) return "";
  const std::string number = shortest(value), in_si = " [" + std::string(unit) + "]";
  constexpr double freezing = 273.15;  // [K]; formulas have no unit with an origin of its own
  const std::string guess = meant == "degC"
                                ? with_unit(value, meant) + ", which is " + short_number(value + freezing, 6) + in_si
                                : number + " [" + std::string(meant) + "]";
  return question(value, meant, guess) + " A number without a unit is in " + std::string(unit) + ": write " + number +
         in_si + " if that is meant";
}

std::size_t telling_place(const Quantity& quantity, const std::vector<double>& values) {
  const auto found = temperature(quantity) ? std::min_element(values.begin(), values.end())
                                           : std::max_element(values.begin(), values.end());
  return static_cast<std::size_t>(found - values.begin());
}

Json written_input(const Quantity& quantity, double value) {
  if (std::isinf(value)) return "infinite";
  if (!std::isfinite(value)) return nullptr;
  return looks_like_si(quantity, value) ? Json(value) : Json(with_unit(value, quantity.unit));
}

Json written_input(const Quantity& quantity, const std::vector<double>& values) {
  if (values.empty() || looks_like_si(quantity, values[telling_place(quantity, values)])) return values;
  Json texts = Json::array();
  for (const double value : values) texts.push_back(with_unit(value, quantity.unit));
  return texts;
}

}  // namespace rollres
