#include "core/scene/scene.hpp"

namespace rollres {

std::vector<std::string_view> input_keys() {
  std::vector<std::string_view> keys;
  const RollingScene scene;
  visit_inputs(scene, [&](const Quantity& quantity, const auto&) { keys.push_back(quantity.key); });
  return keys;
}

}  // namespace rollres
