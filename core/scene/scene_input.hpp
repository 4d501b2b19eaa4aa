#pragma once

/// Inputs of a scene by key: its own, "radius", those of its further layers, counted from 0:
/// "coating_layers[0].layer_thickness", and the numbers of its lists: "relaxation_moduli[2]". What reads, varies or
/// shows an input by its key finds it here.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/scene/scene.hpp"

namespace rollres {

/// The key of a further layer's input, taken apart.
struct LayerKey {
  std::string_view list;   ///< "coating_layers"
  std::size_t layer = 0;   ///< its place in the list
  std::string_view input;  ///< "layer_thickness"

  /// "coating [0]", "lower layer [0]": with the count that the key has.
  std::string layer_in_words() const;
};

/// Takes a key LIST[N].INPUT apart, whether or not there are such a list and input; nothing for any other key.
std::optional<LayerKey> layer_key(std::string_view key);

/// The layers of a scene by name: "layer" in contact with the body, then "lower_layers[0]" and on, "coating_layers[0]"
/// and on.
std::vector<std::string> layer_keys(const RollingScene& scene);

/// A layer of the scene. @param name one of `layer_keys`
MaterialInputs& layer_of(RollingScene& scene, std::string_view name);

/// The key of a number of a list, taken apart.
struct ElementKey {
  std::string_view list;  ///< "relaxation_moduli", of a further layer "coating_layers[0].relaxation_moduli"
  std::size_t place = 0;
};

/// Takes a key LIST[N] apart, whether or not there is such a list; nothing for any other key.
std::optional<ElementKey> element_key(std::string_view key);

/// The key without its layer: "layer_thickness".
std::string_view own_key(std::string_view key);

/// What an input of a further layer is: as `own`, that of a layer, with its whole key and symbol "H of coating [0]".
/// The texts live as long as the program.
const Quantity& layer_quantity(std::string_view list, std::size_t layer, const Quantity& own);

/// What a number of a list is: as the list, with its own key and symbol "g_j [2]". The texts live as long as the
/// program.
const Quantity& element_quantity(const Quantity& list, std::size_t place);

/// Why the scene has no input with this key, if it would have one with more layers or a longer list; else empty.
std::string absent_layer(const RollingScene& scene, std::string_view key);

/// Keys of inputs among which a misspelt one is looked for: all of the scene's own, and, where it looks like one of a
/// further layer, those of that layer.
std::vector<std::string_view> keys_like(std::string_view misspelt);

/// Walks all inputs as `visit_inputs` does, and after each list of layers the inputs of its layers.
template <class Scene, class Visitor>
void visit_all_inputs(Scene& scene, Visitor&& visitor) {
  visit_inputs(scene, [&](const Quantity& quantity, auto& value) {
    visitor(quantity, value);
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, BondedLayers>)
      for (std::size_t i = 0; i < value.size(); ++i)
        visit_layer_inputs(value[i], [&](const Quantity& own, auto& of_layer) {
          visitor(layer_quantity(quantity.key, i, own), of_layer);
        });
  });
}

/// Calls `visitor(quantity, value)` for the input with this key.
/// @return whether the scene has one
template <class Scene, class Visitor>
bool visit_input(Scene& scene, std::string_view key, Visitor&& visitor) {
  bool found = false;
  const std::optional<LayerKey> layered = layer_key(key);
  const std::optional<ElementKey> element = element_key(key);
  const auto visit = [&](const Quantity& quantity, auto& value) {
    if (quantity.key == key) {
      found = true;
      visitor(quantity, value);
    }
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::vector<double>>)
      if (element && quantity.key == element->list && element->place < value.size()) {
        found = true;
        visitor(element_quantity(quantity, element->place), value[element->place]);
      }
  };
  visit_inputs(scene, [&](const Quantity& quantity, auto& value) {
    if (!layered) return visit(quantity, value);
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, BondedLayers>)
      if (quantity.key == layered->list && layered->layer < value.size())
        visit_layer_inputs(value[layered->layer], [&](const Quantity& own, auto& of_layer) {
          if (layered->input.starts_with(own.key)) visit(layer_quantity(quantity.key, layered->layer, own), of_layer);
        });
  });
  return found;
}

}  // namespace rollres
