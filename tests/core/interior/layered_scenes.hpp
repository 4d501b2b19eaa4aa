#pragma once

/// Scenes of more than one layer, of which it is known what is lost where.

#include "core/scene/scene.hpp"

namespace rollres {

/// The scene with a hard elastic layer below its layer, in which nothing is lost.
inline RollingScene on_hard_layer(RollingScene scene) {
  BondedLayer hard;
  hard.material = MaterialModel::elastic;
  hard.static_shear_modulus = 20e6;
  hard.layer_thickness = 0.004;
  scene.lower_layers = {hard};
  return scene;
}

/// The scene with a coating as its layer is: the two may change places.
inline RollingScene coated_alike(RollingScene scene) {
  BondedLayer rubber;
  static_cast<MaterialInputs&>(rubber) = scene;
  rubber.layer_thickness = scene.layer_thickness;
  scene.coating_layers = {rubber};
  return scene;
}

}  // namespace rollres
