#include "studies/evidence/stability_scene.hpp"

#include <cmath>
#include <limits>

#include "core/estimate/grid_choice.hpp"
#include "core/material/material.hpp"
#include "core/numerics/bracketed_root.hpp"
#include "studies/evidence/dice.hpp"
#include "studies/evidence/random_material.hpp"

namespace rollres {

namespace {

/// The load under which the contact of an elastic layer of a modulus has a given half-width.
double load_for(const RollingScene& scene, double modulus, double half_width) {
  const auto excess = [&](double log_load) {
    const ContactEstimate found = elastic_contact_from_load(dimension_of(scene.indenter), scene.radius,
                                                            scene.layer_thickness, modulus, std::exp(log_load));
    return std::log(found.half_width / half_width);
  };
  double low =
      std::log(modulus * half_width * half_width / scene.radius * (dimension_of(scene.indenter) == 3 ? half_width : 1));
  double high = low;
  while (excess(low) > 0) low -= 1;
  while (excess(high) < 0) high += 1;
  return std::exp(bracketed_root(excess, low, high, 1e-10));
}

/// A layer with a thickness of its own beside the first.
BondedLayer second_layer(Dice& dice, const RollingScene& scene, double thickness) {
  BondedLayer layer;
  layer.poisson_ratio = dice.choice(2) == 0 ? 0.5 : 0.3;
  layer.static_shear_modulus = dice.log_uniform(0.3, 30) * *scene.static_shear_modulus;
  layer.stiffening = dice.log_uniform(0.01, 100);
  layer.creep_time = dice.log_uniform(0.01, 100) * scene.creep_time;
  layer.layer_thickness = rounded(thickness);
  return layer;
}

/// Makes the layers in half of the cases others: a half-space, alone or below, several layers, or several coatings.
void draw_layers(Dice& dice, RollingScene& scene) {
  const auto lower = [&] { return second_layer(dice, scene, dice.log_uniform(0.3, 3) * scene.layer_thickness); };
  switch (dice.choice(8)) {
    case 0:
      scene.lower_layers.clear();
      scene.layer_thickness = std::numeric_limits<double>::infinity();
      break;
    case 1:
      scene.lower_layers = {lower()};
      scene.lower_layers.back().layer_thickness = std::numeric_limits<double>::infinity();
      break;
    case 2:
      scene.lower_layers = {lower(), lower()};
      if (dice.choice(2) == 0) scene.lower_layers.push_back(lower());
      break;
    case 3:
      scene.coating_layers.clear();
      for (int count = 1 + dice.choice(2); count > 0; --count)
        scene.coating_layers.push_back(second_layer(dice, scene, dice.log_uniform(0.03, 0.3) * scene.radius));
      break;
    default:
      break;
  }
}

/// Gives all layers materials with long memories, and the load that spreads the contact over the drawn width.
void widen_spectra(Dice& dice, double nodes, RollingScene& scene) {
  const double half_width = dice.log_uniform(scene.radius / 100, scene.radius / 3);
  const double contact_time = half_width / scene.speed;
  draw_layers(dice, scene);
  draw_material(dice, contact_time, scene);
  for (BondedLayers* const layers : {&scene.lower_layers, &scene.coating_layers})
    for (BondedLayer& layer : *layers) draw_material(dice, contact_time, layer);
  const double load = rounded(load_for(scene, std::abs(complex_modulus(scene, 1 / contact_time)), half_width));
  if (scene.driving_torque) *scene.driving_torque = rounded(*scene.driving_torque * load / *scene.load);
  scene.load = load;
  scene.spacing = rounded(2 * estimate_contact(scene).half_width / nodes);
}

}  // namespace

RollingScene stability_scene(Indenter indenter, std::uint64_t seed, std::size_t number, Spectra spectra) {
  Dice dice(mixed(mixed(mixed(seed) + static_cast<std::uint64_t>(indenter)) + number));
  const bool sphere = dimension_of(indenter) == 3;
  RollingScene scene;
  scene.indenter = indenter;
  scene.radius = dice.log_uniform(5e-3, 0.2);
  scene.layer_thickness = dice.log_uniform(1e-3, 0.2);
  scene.static_shear_modulus = dice.log_uniform(1e5, 1e8);
  scene.stiffening = dice.log_uniform(0.01, 100);
  scene.creep_time = dice.log_uniform(1e-5, 10);
  scene.speed = dice.log_uniform(1e-4, 30);
  scene.friction_coefficient = dice.log_uniform(0.005, 2);
  scene.load =
      rounded(load_for(scene, *scene.static_shear_modulus, dice.log_uniform(scene.radius / 100, scene.radius / 3)));
  const double nodes = dice.log_uniform(sphere ? 12 : 20, sphere ? 24 : 60);
  switch (dice.choice(6)) {
    case 0:
      scene.drive = Drive::top_force;
      break;
    case 1:
      scene.drive = Drive::torque;
      scene.driving_torque = rounded(dice.uniform(-1.2, 1.2) * scene.friction_coefficient * *scene.load * scene.radius);
      break;
    case 2:
      scene.drive = Drive::free;
      break;
    case 3:
      scene.drive = Drive::rotation;
      scene.rotation_ratio = 1 + dice.signed_log_uniform(1e-6, 0.3);
      break;
    case 4:
      scene.drive = Drive::rotation;
      scene.rotation_ratio = 0;
      break;
    default:
      scene.drive = Drive::rotation;
      scene.rotation_ratio = dice.signed_log_uniform(2, 100);
      break;
  }
  switch (dice.choice(6)) {  // half of the scenes have one incompressible layer
    case 0:
      scene.poisson_ratio = rounded(dice.uniform(0, 0.49));
      break;
    case 1:
      scene.lower_layers = {second_layer(dice, scene, dice.log_uniform(0.3, 3) * scene.layer_thickness)};
      break;
    case 2:
      scene.coating_layers = {second_layer(dice, scene, dice.log_uniform(0.03, 0.3) * scene.radius)};
      break;
  }
  scene.spacing = rounded(2 * estimate_contact(scene).half_width / nodes);
  const bool by_lot = dice.one_in(2);
  if (spectra == Spectra::wide || (spectra == Spectra::both && by_lot)) widen_spectra(dice, nodes, scene);
  return scene;
}

}  // namespace rollres
