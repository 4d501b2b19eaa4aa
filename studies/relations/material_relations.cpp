#include "studies/relations/relation_kinds.hpp"

#include <algorithm>

#include "core/estimate/grid_choice.hpp"
#include "core/material/material.hpp"
#include "core/material/material_scale.hpp"
#include "core/model/contact_surface.hpp"

namespace rollres {

namespace {

/// G0 f of a Zener solid is the modulus of one Prony term, tau/(1 + f) its relaxation time.
void zener_as_prony(MaterialInputs& layer) {
  layer.material = MaterialModel::prony;
  layer.relaxation_times = {layer.creep_time / (1 + layer.stiffening)};
  layer.relaxation_moduli = {given_static_modulus(layer) * layer.stiffening};
}

/// A layer whose material is a Prony series, or made one; nothing if no layer has a Zener solid or a series.
MaterialInputs* prony_layer(Dice& dice, RollingScene& scene) {
  std::vector<MaterialInputs*> all = layer_materials(scene);
  std::erase_if(all, [](const MaterialInputs* layer) {
    return layer->material != MaterialModel::zener && layer->material != MaterialModel::prony;
  });
  if (all.empty()) return nullptr;
  MaterialInputs* const layer = all[dice.below(all.size())];
  if (layer->material == MaterialModel::zener) zener_as_prony(*layer);
  return layer;
}

void moduli_as_young(MaterialInputs& layer) {
  const double factor = 2 * (1 + layer.poisson_ratio);
  if (layer.static_shear_modulus) {
    layer.static_young_modulus = factor * *layer.static_shear_modulus;
    layer.static_shear_modulus.reset();
  }
  layer.listed_moduli = ListedModuli::young;
  for (auto* const list : {&layer.relaxation_moduli, &layer.storage_moduli, &layer.loss_moduli})
    for (double& modulus : *list) modulus *= factor;
}

/// The times of the layer as they are at its temperature.
void shift_times(MaterialInputs& layer) {
  const double shift = time_shift(layer);
  layer.creep_time *= shift;
  for (double& time : layer.relaxation_times) time *= shift;
  for (double& frequency : layer.frequencies) frequency /= shift;
  layer.temperature.reset();
  layer.reference_temperature.reset();
  layer.wlf_c1.reset();
  layer.wlf_c2.reset();
  layer.activation_energy.reset();
}

}  // namespace

RelatedPair term_split(Dice& dice, RollingScene scene) {
  RollingScene other = scene;
  Dice same = dice;
  MaterialInputs* const layer = prony_layer(dice, scene);
  if (!layer) return {};
  MaterialInputs& split = *prony_layer(same, other);
  const std::size_t term = dice.below(layer->relaxation_times.size());
  split.relaxation_moduli[term] /= 2;
  split.relaxation_moduli.push_back(split.relaxation_moduli[term]);
  split.relaxation_times.push_back(split.relaxation_times[term]);
  return RelatedScenes{.one = scene, .other = known_scene(other)};
}

/// A term of negligible modulus at any time; one that relaxes within 1e-9 of the way through the contact; one that has
/// not relaxed within 1e9 times the longest way.
RelatedPair term_unseen(Dice& dice, RollingScene scene) {
  RollingScene other = scene;
  Dice same = dice;
  MaterialInputs* const layer = prony_layer(dice, scene);
  // A locked coating is at rest, and answers with its modulus at rest.
  if (!layer || ContactModel(scene).flow == 0) return {};
  MaterialInputs& longer = *prony_layer(same, other);
  const double half_width = estimate_contact(scene).half_width, contact_time = half_width / scene.speed;
  const double rest = given_static_modulus(*layer), shift = time_shift(*layer);
  const double modulus = rest * dice.log_uniform(0.1, 10);
  constexpr double beyond = 1e9;
  double time = contact_time / beyond / shift;
  switch (dice.choice(3)) {
    case 0:
      longer.relaxation_moduli.push_back(rest * dice.log_uniform(1e-18, 1e-12));
      longer.relaxation_times.push_back(contact_time * dice.log_uniform(1e-8, 1e8) / shift);
      return RelatedScenes{.one = scene, .other = known_scene(other)};
    case 1: {
      // In the mean of all its turns a ring is at rest, however long it remembers.
      if (ContactModel(scene).ring()) return {};
      const double slowest = *max_element(layer->relaxation_times);
      const double length = std::max(half_width, finite_thickness(scene)) / scene.speed;
      time = beyond * std::max(length / shift, slowest);
      layer->static_shear_modulus = rest + modulus;
      layer->static_young_modulus.reset();
      break;
    }
    default:  // a memory of any length loses its part where a uniform pressure begins and ends
      if (scene.indenter == Indenter::pressure && scene.pressure_distribution == PressureDistribution::uniform)
        return {};
      break;
  }
  longer.relaxation_moduli.push_back(modulus);
  longer.relaxation_times.push_back(time);
  // Moduli differ by 1e-9 of the term's at the frequencies of the contact.
  return RelatedScenes{.one = scene, .other = known_scene(other), .exact = 1e-6};
}

/// The same numbers by other inputs: E for G, a Zener solid as a Prony series or as a fractional one of order 1, times
/// at the temperature for those at the reference.
RelatedPair other_words(Dice& dice, RollingScene scene) {
  RollingScene other = scene;
  for (MaterialInputs* const layer : layer_materials(other)) {
    if (layer->temperature) shift_times(*layer);
    if (layer->material == MaterialModel::zener && layer->stiffening > 0) {
      if (dice.choice(2) == 0)
        zener_as_prony(*layer);
      else
        layer->material = MaterialModel::fractional_zener;
    }
    if (dice.choice(2) == 0) moduli_as_young(*layer);
  }
  return RelatedScenes{.one = scene, .other = known_scene(other)};
}

std::vector<MaterialInputs*> layer_materials(RollingScene& scene) {
  std::vector<MaterialInputs*> all{&scene};
  for (BondedLayers* const layers : {&scene.lower_layers, &scene.coating_layers})
    for (BondedLayer& layer : *layers) all.push_back(&layer);
  return all;
}

}  // namespace rollres
