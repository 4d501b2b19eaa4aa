#include "studies/relations/relations.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "core/estimate/grid_choice.hpp"
#include "core/material/material.hpp"
#include "core/material/material_scale.hpp"
#include "core/model/contact_surface.hpp"
#include "core/model/scene_rules.hpp"
#include "core/scene/scene_input.hpp"

namespace rollres {

namespace {

using Pair = std::optional<RelatedScenes>;

constexpr double infinite_thickness = std::numeric_limits<double>::infinity();

/// An other scene that does not depend on the answer to the first.
auto known(RollingScene scene) {
  return [scene = std::move(scene)](const RollingSolution&) { return scene; };
}

/// The layers of a scene, each as its inputs of material.
std::vector<MaterialInputs*> materials(RollingScene& scene) {
  std::vector<MaterialInputs*> all{&scene};
  for (BondedLayers* const layers : {&scene.lower_layers, &scene.coating_layers})
    for (BondedLayer& layer : *layers) all.push_back(&layer);
  return all;
}

// ---- A layer in several pieces.

/// Parts of a thickness, of an infinite one finite but for the last.
std::vector<double> cut_thickness(Dice& dice, double thickness, double width, int pieces) {
  std::vector<double> parts;
  for (int i = 0; i < pieces; ++i) parts.push_back(dice.uniform(0.2, 1));
  const double unit = std::isinf(thickness) ? width : thickness / std::accumulate(parts.begin(), parts.end(), 0.0);
  for (double& part : parts) part *= unit;
  if (std::isinf(thickness)) parts.back() = infinite_thickness;
  return parts;
}

Pair cut(Dice& dice, const RollingScene& scene, int pieces) {
  RollingScene other = scene;
  const double width = dice.log_uniform(0.1, 10) * estimate_contact(scene).half_width;
  const auto lower = static_cast<int>(scene.lower_layers.size());
  const int layer = dice.choice(1 + lower + static_cast<int>(scene.coating_layers.size()));
  if (layer == 0) {
    const std::vector<double> parts = cut_thickness(dice, scene.layer_thickness, width, pieces);
    other.layer_thickness = parts.front();
    BondedLayer piece;
    static_cast<MaterialInputs&>(piece) = scene;
    piece.layer_density = scene.layer_density;
    for (int i = pieces - 1; i > 0; --i) {
      piece.layer_thickness = parts[static_cast<std::size_t>(i)];
      other.lower_layers.insert(other.lower_layers.begin(), piece);
    }
  } else {
    BondedLayers& list = layer <= lower ? other.lower_layers : other.coating_layers;
    const auto place = list.begin() + (layer <= lower ? layer - 1 : layer - 1 - lower);
    const std::vector<double> parts = cut_thickness(dice, place->layer_thickness, width, pieces);
    const auto first = list.insert(place, static_cast<std::size_t>(pieces - 1), *place);
    for (std::size_t i = 0; i < parts.size(); ++i) (first + static_cast<std::ptrdiff_t>(i))->layer_thickness = parts[i];
  }
  // One layer and several are answered by tables of their own.
  return RelatedScenes{.one = scene, .other = known(other), .exact = 1e-6};
}

Pair cut_in_two(Dice& dice, RollingScene scene) { return cut(dice, scene, 2); }
Pair cut_in_five(Dice& dice, RollingScene scene) { return cut(dice, scene, 5); }

// ---- Materials in other words.

/// G0 f of a Zener solid is the modulus of one Prony term, tau/(1 + f) its relaxation time.
void zener_as_prony(MaterialInputs& layer) {
  layer.material = MaterialModel::prony;
  layer.relaxation_times = {layer.creep_time / (1 + layer.stiffening)};
  layer.relaxation_moduli = {given_static_modulus(layer) * layer.stiffening};
}

/// A layer whose material is a Prony series, or made one; nothing if no layer has a Zener solid or a series.
MaterialInputs* prony_layer(Dice& dice, RollingScene& scene) {
  std::vector<MaterialInputs*> all = materials(scene);
  std::erase_if(all, [](const MaterialInputs* layer) {
    return layer->material != MaterialModel::zener && layer->material != MaterialModel::prony;
  });
  if (all.empty()) return nullptr;
  MaterialInputs* const layer = all[dice.below(all.size())];
  if (layer->material == MaterialModel::zener) zener_as_prony(*layer);
  return layer;
}

Pair term_split(Dice& dice, RollingScene scene) {
  RollingScene other = scene;
  Dice same = dice;
  MaterialInputs* const layer = prony_layer(dice, scene);
  if (!layer) return {};
  MaterialInputs& split = *prony_layer(same, other);
  const std::size_t term = dice.below(layer->relaxation_times.size());
  split.relaxation_moduli[term] /= 2;
  split.relaxation_moduli.push_back(split.relaxation_moduli[term]);
  split.relaxation_times.push_back(split.relaxation_times[term]);
  return RelatedScenes{.one = scene, .other = known(other)};
}

/// A term of negligible modulus at any time; one that relaxes within 1e-9 of the way through the contact; one that has
/// not relaxed within 1e9 times the longest way.
Pair term_unseen(Dice& dice, RollingScene scene) {
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
      longer.relaxation_moduli.push_back(1e-14 * rest);
      longer.relaxation_times.push_back(contact_time * dice.log_uniform(1e-8, 1e8) / shift);
      return RelatedScenes{.one = scene, .other = known(other)};
    case 1: {
      const double slowest = *std::max_element(layer->relaxation_times.begin(), layer->relaxation_times.end());
      const double length = std::max(half_width, finite_thickness(scene)) / scene.speed;
      time = beyond * std::max(length / shift, slowest);
      layer->static_shear_modulus = rest + modulus;
      layer->static_young_modulus.reset();
      break;
    }
    default:
      break;
  }
  longer.relaxation_moduli.push_back(modulus);
  longer.relaxation_times.push_back(time);
  // Moduli differ by 1e-9 of the term's at the frequencies of the contact.
  return RelatedScenes{.one = scene, .other = known(other), .exact = 1e-6};
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

/// The same numbers by other inputs: E for G, a Zener solid as a Prony series or as a fractional one of order 1, times
/// at the temperature for those at the reference.
Pair other_words(Dice& dice, RollingScene scene) {
  RollingScene other = scene;
  for (MaterialInputs* const layer : materials(other)) {
    if (layer->temperature) shift_times(*layer);
    if (layer->material == MaterialModel::zener && layer->stiffening > 0) {
      if (dice.choice(2) == 0)
        zener_as_prony(*layer);
      else
        layer->material = MaterialModel::fractional_zener;
    }
    if (dice.choice(2) == 0) moduli_as_young(*layer);
  }
  return RelatedScenes{.one = scene, .other = known(other)};
}

// ---- Units.

/// Of one scene in four the inside as well, where both answers are to be the same.
void look_inside(Dice& dice, RollingScene& scene) {
  if (dice.choice(4) != 0) return;
  scene.interior = Interior::on;
  if (!check(scene).empty()) scene.interior = Interior::off;
}

double power_of_two(Dice& dice, int most) { return std::ldexp(1.0, dice.choice(2 * most + 1) - most); }

/// Equal but for rounding of logarithms of times, which memories many decades apart amplify: up to 8e-7 of an approach.
Pair scaled(Dice& dice, RollingScene scene, const UnitFactors& factors) {
  look_inside(dice, scene);
  RelatedScenes pair{.one = scene, .other = known(in_units(scene, factors)), .factors = factors};
  pair.exact = 1e-6;
  pair.strict = true;
  return pair;
}

Pair all_scaled(Dice& dice, RollingScene scene) {
  const UnitFactors factors{power_of_two(dice, 8), power_of_two(dice, 12), power_of_two(dice, 16)};
  return scaled(dice, std::move(scene), factors);
}

Pair speed_scaled(Dice& dice, RollingScene scene) {
  const UnitFactors factors{1, 1, power_of_two(dice, 12)};
  return scaled(dice, std::move(scene), factors);
}

/// Loads and torques of a whole cylinder are those per metre times its width. A power of 2, as above.
Pair whole_width(Dice& dice, RollingScene scene) {
  const double width = power_of_two(dice, 6);
  look_inside(dice, scene);
  RollingScene other = scene;
  other.width = width;
  for (std::optional<double>* const given : {&other.load, &other.driving_torque})
    if (*given) **given *= width;
  RelatedScenes pair{.one = scene, .other = known(other), .width = width};
  pair.strict = true;
  return pair;
}

// ---- What is given and what is found.

Pair given_back(Dice&, RollingScene scene) {
  if (!why_absent(scene, "approach").empty()) return {};
  const auto other = [scene](const RollingSolution& found) {
    RollingScene back = scene;
    back.load.reset();
    back.approach.reset();
    (scene.load ? back.approach : back.load) = scene.load ? found.approach : found.load;
    return back;
  };
  // The load of a contact grows like a power of the approach, of at most 3, and the resistance like a power of both.
  return RelatedScenes{.one = scene, .other = other, .sensitivity = 5};
}

// ---- Bodies and layers.

/// Longest way of the body in a retardation time of any layer [m].
double longest_memory(const RollingScene& scene) {
  const ContactModel model(scene);
  double longest = 0;
  for (const ModelLayer* const layer : model.layers())
    if (!layer->creep.terms.empty()) longest = std::max(longest, layer->creep.terms.back().time);
  return scene.speed * longest * std::max(1.0, std::abs(model.flow));
}

/// Without friction nothing else but the load acts on the body.
void leave_friction_out(RollingScene& scene) {
  scene.friction_coefficient = 0;
  scene.drive = Drive::top_force;
  scene.driving_torque.reset();
  scene.rotation_ratio.reset();
}

/// A cylinder's coating is a ring, and flat to H/R: the same contact of a much larger one.
void make_larger(RollingScene& scene) {
  constexpr double larger = 1e5;
  scene.radius *= larger;
  if (scene.load) *scene.load /= larger;
}

/// Without friction only the sum of what both sides yield counts.
Pair exchanged(Dice& dice, RollingScene scene) {
  const double thickest = dice.uniform(0.1, 0.3) * scene.radius;
  if (scene.coating_layers.empty()) {
    if (scene.lower_layers.empty()) return {};
    scene.coating_layers = {scene.lower_layers.back()};
    scene.lower_layers.pop_back();
  }
  scene.layer_thickness = std::min(scene.layer_thickness, thickest);
  for (BondedLayers* const layers : {&scene.lower_layers, &scene.coating_layers})
    for (BondedLayer& layer : *layers) layer.layer_thickness = std::min(layer.layer_thickness, thickest);
  const bool ring = dimension_of(scene.indenter) == 2;
  if (ring) make_larger(scene);
  leave_friction_out(scene);
  scene.inertia = Inertia::off;
  scene.kinematics = Kinematics::consistent;

  // A ring feels what it has not recovered from in a turn; layers never come round.
  constexpr double memories = 30;
  if (ring && memories * longest_memory(scene) > 2 * std::numbers::pi * scene.radius) return {};

  RollingScene other = scene;
  static_cast<MaterialInputs&>(other) = scene.coating_layers.front();
  other.layer_thickness = scene.coating_layers.front().layer_thickness;
  other.lower_layers.assign(scene.coating_layers.begin() + 1, scene.coating_layers.end());
  BondedLayer first;
  static_cast<MaterialInputs&>(first) = scene;
  first.layer_thickness = scene.layer_thickness;
  other.coating_layers = {first};
  other.coating_layers.insert(other.coating_layers.end(), scene.lower_layers.begin(), scene.lower_layers.end());
  // Whose slope the pressure pushes against decides how the resistance is shared by force and torque.
  return RelatedScenes{.one = scene,
                       .other = known(other),
                       .exact = ring ? 1e-5 : 1e-7,
                       .left_out = {"driving_force", "driving_torque"}};
}

/// Inertia of layers that weigh next to nothing for none.
Pair weightless(Dice& dice, RollingScene scene) {
  const bool ring = dimension_of(scene.indenter) == 2 && !scene.coating_layers.empty();
  constexpr double memories = 30;  // as above: with inertia a coating never comes round
  if (ring) {
    // What shear does to a ring goes with a/R, whatever its thickness.
    leave_friction_out(scene);
    make_larger(scene);
    if (memories * longest_memory(scene) > 2 * std::numbers::pi * scene.radius) return {};
  }
  double softest = INFINITY;
  for (const ModelLayer* const layer : ContactModel(scene).layers())
    softest = std::min(softest, layer->modulus_at_rest);
  const double number = dice.log_uniform(1e-17, 1e-8), density = number * softest / (scene.speed * scene.speed);
  scene.inertia = Inertia::off;
  RollingScene other = scene;
  other.inertia = Inertia::on;
  other.layer_density = density;
  for (BondedLayers* const layers : {&other.lower_layers, &other.coating_layers})
    for (BondedLayer& layer : *layers) layer.layer_density = density;
  // Methods may differ, by what each states or the tolerance asks for; of shear's peaks and of losses none is stated.
  return RelatedScenes{.one = scene,
                       .other = known(other),
                       .exact = ring ? 1e-5 : 1e-6,
                       .resistance = scene.tolerance.value_or(0),
                       .left_out = {"peak_shear_x", "peak_shear_y", "viscous_loss", "frictional_loss"}};
}

/// Of a cylinder's layers: the contact's sagitta over their thickness, or over the half-width where that is less [1].
double strain_estimate(const RollingScene& scene) {
  const double half_width = estimate_contact(scene).half_width;
  return half_width * half_width / scene.radius / std::min(half_width, total_thickness(scene));
}

/// On elastic layers a cylinder that slides forwards everywhere is the mirror image of one that slides backwards. It
/// slides so where the creepage is larger than the strains along the surface, of about the approach over the depth.
Pair mirrored(Dice& dice, RollingScene scene) {
  for (MaterialInputs* const layer : materials(scene)) {
    if (!layer->static_shear_modulus) return {};
    layer->material = MaterialModel::elastic;
  }
  scene.inertia = Inertia::off;
  scene.kinematics = Kinematics::consistent;
  if (scene.friction_coefficient == 0) scene.friction_coefficient = dice.log_uniform(0.005, 0.5);
  scene.friction_coefficient = std::min(scene.friction_coefficient, 0.5);
  scene.drive = Drive::rotation;
  scene.driving_torque.reset();
  const double strain = strain_estimate(scene), slide = std::max(1.0, 10 * strain);
  // A coating's strains count by how fast it turns.
  constexpr double small_strain = 0.1;
  if (!scene.coating_layers.empty() && strain > small_strain) return {};
  scene.rotation_ratio = rounded(1 - slide);
  RollingScene other = scene;
  other.rotation_ratio = rounded(1 + slide * (dice.uniform(2, 10) - 1));
  // Grids differ from their mirror images by what their origin, the contact's centre as estimated, is known to.
  return RelatedScenes{.one = scene,
                       .other = known(other),
                       .exact = 1e-6,
                       .mirrored = true,
                       .left_out = {"rolling_resistance", "rotation_ratio", "viscous_loss", "frictional_loss"}};
}

Pair long_period(Dice&, RollingScene scene) {
  if (!on_grid(scene.method) || !scene.spacing || !has_rigid_base(scene)) return {};
  scene.inertia = Inertia::off;
  // Memories fade to e^-25 = 1e-11, elastic displacements within 10 H to less.
  const double period =
      std::max({25 * longest_memory(scene), 30 * finite_thickness(scene), 30 * estimate_contact(scene).half_width});
  constexpr double waves_per_cell = 24;
  const double terms = waves_per_cell * period / *scene.spacing;
  constexpr double most_terms = 400'000;
  if (terms > most_terms) return {};
  RollingScene other = scene;
  other.period = period;
  other.series_terms = static_cast<int>(terms);
  // The sum over wavenumbers ends at 24 waves to a cell, and lacks the square of a 24th of what a cell yields.
  return RelatedScenes{.one = scene, .other = known(other), .exact = 2e-3};
}

Pair deep_layer(Dice&, RollingScene scene) {
  if (!scene.load) return {};
  (scene.lower_layers.empty() ? scene.layer_thickness : scene.lower_layers.back().layer_thickness) = infinite_thickness;
  // A layer of 1,000 memories: over longer ways it is stiffer than a half-space, and slow memories feel that.
  const double depth =
      1000 * std::max({estimate_contact(scene).half_width, longest_memory(scene), finite_thickness(scene)});
  constexpr double deepest = 1e6;  // of what `check` takes for a layer, a tenth [m]
  if (depth > deepest) return {};
  RollingScene other = scene;
  (scene.lower_layers.empty() ? other.layer_thickness : other.lower_layers.back().layer_thickness) = depth;
  // Waves longer than the layer is deep give (1/1000)^2, times their decades; but a load stretches an incompressible
  // layer, not a half-space, by about P/(pi G H), a thousandth of the contact's strains, which friction feels.
  const bool slips = scene.friction_coefficient > 0;
  if (slips && scene.drive == Drive::rotation && std::abs(*scene.rotation_ratio - 1) < 0.1) return {};
  return RelatedScenes{.one = scene, .other = known(other), .exact = slips ? 1e-3 : 1e-5, .left_out = {"approach"}};
}

Pair tolerances(Dice&, RollingScene scene) {
  if (scene.method == Method::active_set || scene.method == Method::newton_dense) return {};
  const bool sphere = dimension_of(scene.indenter) == 3;
  scene.spacing.reset();
  scene.tolerance = sphere ? 1e-2 : 1e-3;
  RollingScene other = scene;
  other.tolerance = sphere ? 1e-3 : scene.method == Method::automatic ? 1e-6 : 1e-4;
  return RelatedScenes{.one = scene,
                       .other = known(other),
                       .resistance = *scene.tolerance,
                       .left_out = {"peak_shear_x", "peak_shear_y"}};
}

constexpr std::array<Relation, 15> all_relations{{
    {"cut in two", "a layer, or a coating, as two of the same material", cut_in_two},
    {"cut in five", "the same as five", cut_in_five},
    {"term split", "a Prony term as two of half its modulus", term_split},
    {"term unseen", "a Prony term more that the contact cannot see", term_unseen},
    {"other words", "the same material by other inputs", other_words},
    {"scaled", "lengths, moduli and times in other units", all_scaled},
    {"speed and memories", "a speed times a number, all times over it", speed_scaled},
    {"whole width", "loads and torques of a cylinder's whole width for those per metre", whole_width, false},
    {"given back", "load given, approach found and given in its place, or the other way round", given_back},
    {"exchanged", "without friction, the body's coating for what lies below", exchanged},
    {"weightless", "inertia of layers that weigh next to nothing for none", weightless},
    {"mirrored", "on elastic layers, sliding forwards for sliding backwards", mirrored, false},
    {"long period", "bodies far apart for a single one", long_period, false},
    {"deep layer", "a layer of 1,000 half-widths for a half-space", deep_layer},
    {"tolerance", "a tolerance of 1e-3 for 1e-6", tolerances},
}};

// ---- Scenes that relations are tried on.

void draw_cylinder_method(Dice& dice, RollingScene& scene) {
  const std::optional<double> spacing = std::exchange(scene.spacing, std::nullopt);
  const auto gridded = [&](Method method) {
    scene.method = method;
    scene.spacing = spacing;
  };
  switch (dice.choice(12)) {
    case 0:
      break;
    case 1:
    case 2:
      scene.tolerance = 1e-3;
      break;
    case 3:
      scene.method = Method::newton;
      scene.tolerance = 1e-3;
      break;
    case 4:
    case 5:
      gridded(Method::newton);
      break;
    case 6:
      gridded(Method::newton_dense);
      break;
    case 7:
      gridded(Method::active_set);
      break;
    default:
      scene.tolerance = 1e-6;
      break;
  }
}

void draw_sphere_method(Dice& dice, RollingScene& scene) {
  const int choice = dice.choice(8);
  scene.method = choice == 0 ? Method::newton_dense : choice == 1 ? Method::active_set : Method::newton;
  if (choice != 2) return;
  scene.spacing.reset();
  scene.tolerance = 1e-2;
}

RollingScene scene_to_relate(Dice& dice, RollingScene scene) {
  if (dice.choice(3) == 0) leave_friction_out(scene);
  if (dice.choice(4) != 0) scene.inertia = Inertia::off;
  if (dice.choice(6) == 0) scene.kinematics = Kinematics::printed;
  const double approach = dice.choice(2) == 0 ? estimate_contact(scene).approach : RollingSolution::absent;
  if (approach < 0.5 * scene.radius && why_absent(scene, "approach").empty()) {
    scene.load.reset();
    scene.approach = rounded(approach);
  }
  if (dimension_of(scene.indenter) == 3)
    draw_sphere_method(dice, scene);
  else
    draw_cylinder_method(dice, scene);
  return scene;
}

}  // namespace

double UnitFactors::of(std::string_view unit) const {
  struct Dimension {
    std::string_view unit;
    int length, modulus, time;
  };
  static constexpr std::array<Dimension, 14> dimensions{{{"m", 1, 0, 0},
                                                         {"m2", 2, 0, 0},
                                                         {"Pa", 0, 1, 0},
                                                         {"s", 0, 0, 1},
                                                         {"Hz", 0, 0, -1},
                                                         {"rad/s", 0, 0, -1},
                                                         {"m/s", 1, 0, -1},
                                                         {"kg/m3", -2, 1, 2},
                                                         {"N", 2, 1, 0},
                                                         {"N/m", 1, 1, 0},
                                                         {"N.m", 3, 1, 0},
                                                         {"W", 3, 1, -1},
                                                         {"W/m", 2, 1, -1},
                                                         {"1/m", -1, 0, 0}}};
  for (const Dimension& dimension : dimensions)
    if (dimension.unit == unit)
      return std::pow(length, dimension.length) * std::pow(modulus, dimension.modulus) * std::pow(time, dimension.time);
  return 1;
}

RollingScene in_units(RollingScene scene, const UnitFactors& factors) {
  visit_all_inputs(scene, [&](const Quantity& quantity, auto& value) {
    using Value = std::decay_t<decltype(value)>;
    const double factor = quantity.key == "time_limit" ? 1 : factors.of(quantity.unit_for(body_of(scene)));
    if constexpr (std::is_same_v<Value, double>)
      value *= factor;
    else if constexpr (std::is_same_v<Value, std::optional<double>>) {
      if (value) *value *= factor;
    } else if constexpr (std::is_same_v<Value, std::vector<double>>)
      for (double& number : value) number *= factor;
  });
  return scene;
}

std::span<const Relation> relations() { return all_relations; }

RelatedScenes related_scenes(const Relation& relation, Indenter indenter, std::uint64_t seed, std::size_t number,
                             Spectra spectra) {
  RollingSolution found;  // an answer that gives the other scene something to be checked with
  found.load = found.approach = 1e-4;
  std::uint64_t named = mixed(mixed(seed) + number);
  for (const char letter : relation.name) named = mixed(named + static_cast<unsigned char>(letter));
  constexpr std::uint64_t most_attempts = 10'000;  // a hundred are seldom needed
  for (std::uint64_t attempt = 0; attempt < most_attempts; ++attempt) {
    const std::uint64_t lot = mixed(named + attempt);
    Dice dice(lot);
    const RollingScene scene = scene_to_relate(dice, stability_scene(indenter, lot, number, spectra));
    if (!check(scene).empty()) continue;
    Pair scenes = relation.scenes(dice, scene);
    if (scenes && check(scenes->one).empty() && check(scenes->other(found)).empty()) return std::move(*scenes);
  }
  throw std::logic_error("no random scene fits the relation " + std::string(relation.name));
}

}  // namespace rollres
