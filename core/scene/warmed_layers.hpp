#pragma once

/// The layers that the heat of rolling warms: those on the body, or, of a body without, those under it (a belt that
/// comes round again). A floor under a covered body is always met where it has not been warmed.

#include <vector>

#include "core/scene/scene.hpp"

namespace rollres {

/// Their materials, from the contact away.
std::vector<const MaterialInputs*> warmed_layers(const RollingScene& scene);

/// The same scene without heat, its warmed layers at a temperature: those whose materials have a law of shift.
/// @param temperature [K]
RollingScene at_temperature(RollingScene scene, double temperature);

/// Layers cut into sublayers of equal thickness, from the contact away, each at its own temperature: those whose
/// materials have a law of shift.
/// @param temperatures of the sublayers, as many in each layer [K]
BondedLayers in_sublayers(const BondedLayers& layers, const std::vector<double>& temperatures);

/// Depths of the middles of these below the face in contact [m].
std::vector<double> sublayer_depths(const RollingScene& scene, int in_each);

/// The same scene without heat, its warmed layers in sublayers.
RollingScene at_temperatures(RollingScene scene, const std::vector<double>& temperatures);

/// Whether a material of the warmed layers depends on the temperature.
bool depends_on_temperature(const RollingScene& scene);

/// Thickness of all warmed layers [m].
double warmed_thickness(const RollingScene& scene);

/// The temperatures of what takes heat away, where it does: air, ground, core, each with the key that gives it [K].
struct Surroundings {
  std::string_view key;
  double temperature;
};
/// @pre there is an ambient_temperature
std::vector<Surroundings> surroundings(const RollingScene& scene);

}  // namespace rollres
