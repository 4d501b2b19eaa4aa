#pragma once

/// A further layer of a scene, below the first or on the body, as a plain value.

#include <vector>

#include "core/scene/material_inputs.hpp"

namespace rollres {

struct BondedLayer : MaterialInputs {
  double layer_thickness = 0;   // [m]; infinity for a half-space at the bottom
  double layer_density = 1000;  // [kg/m3]

  bool operator==(const BondedLayer&) const = default;
};

using BondedLayers = std::vector<BondedLayer>;

/// Walks the inputs that every layer has, a scene's own among them, as `visit_inputs` does.
template <class Inputs, class Visitor>
void visit_layer_inputs(Inputs& layer, Visitor&& visitor) {
  using Q = Quantity;
  visitor(Q{"layer_thickness",
            "H",
            "m",
            "thickness of the layer; \"infinite\" for a half-space",
            {.lowest = 0.0, .lowest_excluded = true, .infinity_allowed = true}},
          layer.layer_thickness);
  visitor(Q{"layer_density", "ρ", "kg/m3", "density of the layer", not_negative}, layer.layer_density);
  visit_material_inputs(layer, visitor);
}

}  // namespace rollres
