#include "core/scene/warmed_layers.hpp"

#include <type_traits>
#include <utility>

namespace rollres {

namespace {

/// Those of a scene, const or not, from the contact away.
template <class Scene, class Visitor>
void visit_warmed(Scene& scene, const Visitor& visitor) {
  using Layer = std::conditional_t<std::is_const_v<Scene>, const BondedLayer, BondedLayer>;
  const bool covered = !scene.coating_layers.empty();
  if (!covered) visitor(static_cast<Layer&>(scene));
  for (Layer& layer : covered ? scene.coating_layers : scene.lower_layers) visitor(layer);
}

}  // namespace

std::vector<const MaterialInputs*> warmed_layers(const RollingScene& scene) {
  std::vector<const MaterialInputs*> layers;
  visit_warmed(scene, [&](const BondedLayer& layer) { layers.push_back(&layer); });
  return layers;
}

RollingScene at_temperature(RollingScene scene, double temperature) {
  scene.heat = Heat::off;
  visit_warmed(scene, [&](BondedLayer& layer) {
    if (has_shift(layer)) layer.temperature = temperature;
  });
  return scene;
}

RollingScene at_temperatures(RollingScene scene, int pieces, const std::function<double(double)>& temperature) {
  scene.heat = Heat::off;
  BondedLayers cut;
  double depth = 0;
  visit_warmed(std::as_const(scene), [&](const BondedLayer& layer) {
    BondedLayer piece = layer;
    piece.layer_thickness /= pieces;
    for (int i = 0; i < pieces; ++i, depth += piece.layer_thickness) {
      if (has_shift(piece)) piece.temperature = temperature(depth + 0.5 * piece.layer_thickness);
      cut.push_back(piece);
    }
  });
  if (scene.coating_layers.empty()) {
    static_cast<BondedLayer&>(scene) = cut.front();
    scene.lower_layers.assign(cut.begin() + 1, cut.end());
  } else {
    scene.coating_layers = std::move(cut);
  }
  return scene;
}

bool depends_on_temperature(const RollingScene& scene) {
  for (const MaterialInputs* const layer : warmed_layers(scene))
    if (has_shift(*layer)) return true;
  return false;
}

double warmed_thickness(const RollingScene& scene) {
  double thickness = 0;
  visit_warmed(scene, [&](const BondedLayer& layer) { thickness += layer.layer_thickness; });
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
