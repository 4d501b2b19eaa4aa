#pragma once

/// Further layers of a scene as text: a JSON list of objects, each with the inputs that differ from a layer's defaults,
/// numbers as short as every bit of them can be read back.

#include <string>

#include "core/scene/bonded_layer.hpp"

namespace rollres {

std::string text_of_layers(const BondedLayers& layers);

/// @throws std::invalid_argument if the text is not of that form
BondedLayers layers_in(const std::string& text);

}  // namespace rollres
