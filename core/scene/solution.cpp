#include "core/scene/solution.hpp"

#include <sstream>

namespace rollres {

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
