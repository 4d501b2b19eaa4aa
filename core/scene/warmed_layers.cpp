#include "core/scene/warmed_layers.hpp"

#include <utility>

namespace rollres {

namespace {

/// From the contact away.
BondedLayers layers_that_warm(const RollingScene& scene) {
  if (!scene.coating_layers.empty()) return scene.coating_layers;
  BondedLayers layers{scene};
  layers.insert(layers.end(), scene.lower_layers.begin(), scene.lower_layers.end());
  return layers;
}

}  // namespace

std::vector<const MaterialInputs*> warmed_layers(const RollingScene& scene) {
  std::vector<const MaterialInputs*> layers;
  const bool covered = !scene.coating_layers.empty();
  if (!covered) layers.push_back(&scene);
  for (const BondedLayer& layer : covered ? scene.coating_layers : scene.lower_layers) layers.push_back(&layer);
  return layers;
}

BondedLayers in_sublayers(const BondedLayers& layers, const std::vector<double>& temperatures) {
  const std::size_t in_each = temperatures.size() / layers.size();
  BondedLayers cut;
  for (const BondedLayer& layer : layers)
    for (std::size_t i = 0; i < in_each; ++i) {
      BondedLayer sublayer = layer;
      sublayer.layer_thickness /= static_cast<double>(in_each);
      if (has_shift(sublayer)) sublayer.temperature = temperatures[cut.size()];
      cut.push_back(std::move(sublayer));
    }
  return cut;
}

std::vector<double> sublayer_depths(const RollingScene& scene, int in_each) {
  std::vector<double> depths;
  double face = 0;
  for (const BondedLayer& layer : layers_that_warm(scene)) {
    for (int i = 0; i < in_each; ++i) depths.push_back(face + layer.layer_thickness * (i + 0.5) / in_each);
    face += layer.layer_thickness;
  }
  return depths;
}

RollingScene at_temperatures(RollingScene scene, const std::vector<double>& temperatures) {
  scene.heat = Heat::off;
  BondedLayers cut = in_sublayers(layers_that_warm(scene), temperatures);
  if (scene.coating_layers.empty()) {
    static_cast<BondedLayer&>(scene) = cut.front();
    cut.erase(cut.begin());
    scene.lower_layers = std::move(cut);
  } else {
    scene.coating_layers = std::move(cut);
  }
  return scene;
}

RollingScene at_temperature(RollingScene scene, double temperature) {
  const std::size_t layers = warmed_layers(scene).size();
  return at_temperatures(std::move(scene), std::vector<double>(layers, temperature));
}

bool depends_on_temperature(const RollingScene& scene) {
  for (const MaterialInputs* const layer : warmed_layers(scene))
    if (has_shift(*layer)) return true;
  return false;
}

double warmed_thickness(const RollingScene& scene) {
  double thickness = 0;
  for (const BondedLayer& layer : layers_that_warm(scene)) thickness += layer.layer_thickness;
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
