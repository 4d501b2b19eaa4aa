#include "core/scene/solution.hpp"

#include <sstream>
#include <type_traits>

#include "core/scene/scene_input.hpp"

namespace rollres {

std::optional<Quantity> output_quantity(std::string_view key) {
  std::optional<Quantity> found;
  const std::optional<ElementKey> element = element_key(key);
  const RollingSolution none;
  visit_outputs(none, [&](const Quantity& quantity, const auto& value) {
    if (quantity.key == key) found = quantity;
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::vector<double>>)
      if (element && quantity.key == element->list) found = element_quantity(quantity, element->place);
  });
  return found;
}

double output_number(const RollingSolution& solution, std::string_view key) {
  double found = RollingSolution::absent;
  const std::optional<ElementKey> element = element_key(key);
  visit_outputs(solution, [&](const Quantity& quantity, const auto& value) {
    using Value = std::decay_t<decltype(value)>;
    if constexpr (std::is_arithmetic_v<Value>) {
      if (quantity.key == key) found = static_cast<double>(value);
    } else if constexpr (std::is_same_v<Value, std::vector<double>>) {
      if (element && quantity.key == element->list && element->place < value.size()) found = value[element->place];
    }
  });
  return found;
}

std::string too_much_traction(double needed, double given) {
  std::ostringstream text;
  text << "the drive asks for more traction than friction can give: needs a friction coefficient of at least " << needed
       << ", has " << given;
  return text.str();
}

std::vector<std::string_view> output_keys() {
  std::vector<std::string_view> keys;
  const RollingSolution solution;
  visit_outputs(solution, [&](const Quantity& quantity, const auto&) { keys.push_back(quantity.key); });
  return keys;
}

}  // namespace rollres
