#include "core/heat/heat_path.hpp"

#include <numbers>

#include "core/scene/warmed_layers.hpp"

namespace rollres {

namespace {

using std::numbers::pi;

HeatExit core_exit(const RollingScene& scene, double area) {
  if (scene.core == CoreHeat::insulated) return {};
  const double temperature = scene.core_temperature.value_or(*scene.ambient_temperature);
  if (scene.core_heat_transfer) return {*scene.core_heat_transfer * area, temperature};
  return {scene.core_temperature ? INFINITY : 0, temperature};
}

}  // namespace

double HeatPath::resistance(double depth) const {
  return (std::isinf(radius) ? depth : -radius * std::log1p(-depth / radius)) / (conductivity * turn);
}

HeatPath heat_path(const RollingScene& scene, double contact) {
  HeatPath path;
  path.thickness = warmed_thickness(scene);
  path.conductivity = *scene.thermal_conductivity;
  const bool ring = !scene.coating_layers.empty();
  if (ring) path.radius = scene.radius;
  path.turn = ring ? 2 * pi * scene.radius : *scene.turn_length;
  path.air = {*scene.surface_heat_transfer * path.turn, *scene.ambient_temperature};
  path.ground.temperature = scene.ground_temperature.value_or(*scene.ambient_temperature);
  if (scene.ground_effusivity > 0) {
    const double own = std::sqrt(path.conductivity * *scene.heat_capacity);
    const double both = own * scene.ground_effusivity / (own + scene.ground_effusivity);
    path.ground.conductance = 2 * both * std::sqrt(contact / scene.speed / pi) * scene.speed;  // h_c times the turn
  }
  path.core = core_exit(scene, path.turn * (ring ? 1 - path.thickness / path.radius : 1));
  return path;
}

HeatNumbers heat_numbers(const RollingScene& scene, const HeatPath& path) {
  HeatNumbers numbers;
  numbers.biot = (path.air.conductance + path.ground.conductance) / path.turn * path.thickness / path.conductivity;
  if (!scene.heat_capacity) return numbers;
  numbers.warming_time = path.thickness * path.thickness * *scene.heat_capacity / path.conductivity;
  numbers.fourier = path.turn / scene.speed / numbers.warming_time;
  numbers.peclet = 2 * pi / numbers.fourier;
  return numbers;
}

}  // namespace rollres
