#include "studies/scene_io/layer_entries.hpp"

#include <algorithm>
#include <stdexcept>

namespace rollres {

namespace {

BondedLayer layer_of_object(const SceneEntry& owner, const Json& object) {
  if (!object.is_object()) refuse(owner.place, owner.key, object, "must be an object with the inputs of a layer");
  BondedLayer layer;
  std::vector<std::string_view> known, given;
  for (const InputKind& kind : layer_kinds()) known.push_back(kind.quantity.key);
  for (const auto& [key, value] : object.items()) {
    if (find_name(ignored_keys, key) >= 0) continue;
    const auto kind = std::find_if(layer_kinds().begin(), layer_kinds().end(),
                                   [&](const InputKind& candidate) { return candidate.quantity.key == key; });
    const SceneEntry entry{owner.key + "." + key, value, owner.place};
    if (kind == layer_kinds().end()) refuse(entry.place, entry.key, value, unknown("unknown key", known, key));
    assign_layer_input(layer, kind->quantity.key, input_value(entry, *kind, Indenter::cylinder));
    given.push_back(kind->quantity.key);
  }
  for (const InputKind& kind : layer_kinds())
    if ((kind.needed_by_all() || kind.needed_by(layer.material)) && find_name(given, kind.quantity.key) < 0)
      throw std::invalid_argument(owner.place + ": " + owner.key + "." + std::string(kind.quantity.key) +
                                  " is missing: this layer needs it (" + std::string(kind.quantity.unit) + ")");
  return layer;
}

}  // namespace

BondedLayers layers_of(const SceneEntry& entry) {
  if (!entry.value.is_array() || entry.value.empty())
    refuse(entry.place, entry.key, entry.value, "must be a list of objects, one for each layer");
  BondedLayers layers;
  for (const Json& object : entry.value)
    layers.push_back(layer_of_object({entry.key + "[" + std::to_string(layers.size()) + "]", {}, entry.place}, object));
  return layers;
}

}  // namespace rollres
