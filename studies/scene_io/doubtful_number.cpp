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

/// The unit that was meant instead; empty if the number looks like one in SI.
std::string_view meant_unit(const Quantity& quantity, double value) {
  constexpr double long_one = 1, soft = 1e3, stiff = 1e12, cold = 150;  // [m], [Pa], [Pa], [K]
  if (!std::isfinite(value)) return "";
  if (quantity.unit == "m") return value > long_one ? "mm" : "";
  if (temperature(quantity)) return value < cold ? "degC" : "";
  const std::string_view own = own_key(quantity.key);
  if (!modulus(own)) return "";
  const bool one_of_list = own.find('[') != std::string_view::npos;  // of a series: as small as one likes
  return value > stiff || (value > 0 && value < soft && !one_of_list) ? "MPa" : "";
}

std::string with_unit(double value, std::string_view unit) { return shortest(value) + " " + std::string(unit); }

}  // namespace

std::string doubt_of(const Quantity& quantity, double value) {
  const std::string_view meant = meant_unit(quantity, value);
  if (meant.empty()) return "";
  return "did you mean \"" + with_unit(value, meant) + "\"? A number without a unit is in " +
         std::string(quantity.unit) + ": write \"" + with_unit(value, quantity.unit) + "\" if that is meant";
}

std::size_t telling_place(const Quantity& quantity, const std::vector<double>& values) {
  const auto found = temperature(quantity) ? std::min_element(values.begin(), values.end())
                                           : std::max_element(values.begin(), values.end());
  return static_cast<std::size_t>(found - values.begin());
}

Json written_input(const Quantity& quantity, double value) {
  if (std::isinf(value)) return "infinite";
  if (!std::isfinite(value)) return nullptr;
  return meant_unit(quantity, value).empty() ? Json(value) : Json(with_unit(value, quantity.unit));
}

Json written_input(const Quantity& quantity, const std::vector<double>& values) {
  if (values.empty() || meant_unit(quantity, values[telling_place(quantity, values)]).empty()) return values;
  Json texts = Json::array();
  for (const double value : values) texts.push_back(with_unit(value, quantity.unit));
  return texts;
}

}  // namespace rollres
