#pragma once

/// A further layer of a scene, below the first or on the body, as a plain value.

#include <span>
#include <vector>

#include "core/scene/material_inputs.hpp"

namespace rollres {

struct BondedLayer : MaterialInputs {
  double layer_thickness = 0;   // [m]; infinity for a half-space at the bottom
  double layer_density = 1000;  // [kg/m3]

  bool operator==(const BondedLayer&) const = default;
};

using BondedLayers = std::vector<BondedLayer>;

/// The inputs that a layer has beside those of its material.
using LayerInput = ListedQuantity<BondedLayer, double>;
std::span<const LayerInput> listed_layer_inputs();

/// Walks the inputs that every layer has, a scene's own among them, as `visit_inputs` does.
template <class Inputs, class Visitor>
void visit_layer_inputs(Inputs& layer, Visitor&& visitor) {
  visit_listed(layer, listed_layer_inputs(), visitor);
  visit_material_inputs(layer, visitor);
}

}  // namespace rollres
