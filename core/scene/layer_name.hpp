#pragma once

#include <string>

namespace rollres {

/// How messages, models and tables name a layer: "layer" in contact with the body, "lower layer [0]" below it, "coating
/// [0]" on the body, counted as the keys of scene files are.
/// @param place  under the body 0 for the layer in contact, on it 0 for the coating that coating_layers[0] is
std::string layer_name(bool on_body, std::size_t place);

}  // namespace rollres
