#pragma once

/// A filled rubber's master curve (data file measured_dma of the public project perssonmodelling), E' and E".

#include "core/scene/scene.hpp"

namespace rollres {

inline MaterialInputs filled_rubber() {
  MaterialInputs layer;
  layer.material = MaterialModel::master_curve;
  layer.listed_moduli = ListedModuli::young;
  layer.frequencies = {4.18e-3, 1.00, 1e2, 2.09e3, 1.51e4, 9.39e5, 1.71e8, 9.08e9, 9.89e12};
  layer.storage_moduli = {6.68e6, 8.93e6, 12.3e6, 16.6e6, 20.7e6, 46.0e6, 239e6, 1020e6, 5030e6};
  layer.loss_moduli = {0.737e6, 1.21e6, 2.13e6, 4.06e6, 6.51e6, 23.2e6, 168e6, 494e6, 1410e6};
  return layer;
}

/// The scene with its layer of another material.
inline RollingScene with_material(RollingScene scene, const MaterialInputs& layer) {
  static_cast<MaterialInputs&>(scene) = layer;
  return scene;
}

}  // namespace rollres
