#include "core/scene/warmed_layers.hpp"

namespace rollres {

std::vector<const MaterialInputs*> warmed_layers(const RollingScene& scene) {
  std::vector<const MaterialInputs*> layers;
  if (scene.coating_layers.empty()) layers.push_back(&scene);
  for (const BondedLayer& layer : scene.coating_layers.empty() ? scene.lower_layers : scene.coating_layers)
    layers.push_back(&layer);
  return layers;
}

RollingScene at_temperature(RollingScene scene, double temperature) {
  scene.heat = Heat::off;
  const auto warm = [&](MaterialInputs& layer) {
    if (has_shift(layer)) layer.temperature = temperature;
  };
  if (scene.coating_layers.empty()) warm(scene);
  for (BondedLayer& layer : scene.coating_layers.empty() ? scene.lower_layers : scene.coating_layers) warm(layer);
  return scene;
}

bool depends_on_temperature(const RollingScene& scene) {
  for (const MaterialInputs* const layer : warmed_layers(scene))
    if (has_shift(*layer)) return true;
  return false;
}

double warmed_thickness(const RollingScene& scene) {
  double thickness = scene.coating_layers.empty() ? scene.layer_thickness : 0;
  for (const BondedLayer& layer : scene.coating_layers.empty() ? scene.lower_layers : scene.coating_layers)
    thickness += layer.layer_thickness;
  return thickness;
}

std::vector<Surroundings> surroundings(const RollingScene& scene) {
  std::vector<Surroundings> all{{"ambient_temperature", *scene.ambient_temperature}};
  if (scene.ground_effusivity > 0 && scene.ground_temperature)
    all.push_back({"ground_temperature", *scene.ground_temperature});
  if (scene.core_temperature) all.push_back({"core_temperature", *scene.core_temperature});
  return all;
}

}  // namespace rollres
