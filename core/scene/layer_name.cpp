#include "core/scene/layer_name.hpp"

#include "core/scene/scene_input.hpp"

namespace rollres {

std::string layer_name(bool on_body, std::size_t place) {
  if (on_body) return LayerKey{"coating_layers", place, {}}.layer_in_words();
  return place == 0 ? "layer" : LayerKey{"lower_layers", place - 1, {}}.layer_in_words();
}

}  // namespace rollres
