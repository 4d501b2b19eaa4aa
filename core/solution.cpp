#include "core/solution.hpp"

namespace rollres {

std::vector<std::string_view> output_keys() {
  std::vector<std::string_view> keys;
  const RollingSolution solution;
  visit_outputs(solution, [&](const Quantity& quantity, const auto&) { keys.push_back(quantity.key); });
  return keys;
}

}  // namespace rollres
