#pragma once

/// Further layers of a scene in files: a list of objects whose keys are those of a scene's own layer. For sources only:
/// it needs nlohmann_json.

#include "core/scene/bonded_layer.hpp"
#include "studies/scene_io/scene_entries.hpp"

namespace rollres {

/// The layers of an entry "lower_layers" or "coating_layers".
/// @throws std::invalid_argument naming place, layer and key, value and rule
BondedLayers layers_of(const SceneEntry& entry);

}  // namespace rollres
