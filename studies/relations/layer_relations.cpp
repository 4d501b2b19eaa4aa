#include "studies/relations/relation_kinds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "core/estimate/grid_choice.hpp"
#include "core/material/material.hpp"
#include "core/model/contact_surface.hpp"
#include "studies/relations/scenes_to_relate.hpp"

namespace rollres {

namespace {

constexpr double infinite_thickness = std::numeric_limits<double>::infinity();

/// Parts of a thickness, of an infinite one finite but for the last.
std::vector<double> cut_thickness(Dice& dice, double thickness, double width, int pieces) {
  std::vector<double> parts;
  for (int i = 0; i < pieces; ++i) parts.push_back(dice.uniform(0.2, 1));
  const double unit = std::isinf(thickness) ? width : thickness / std::accumulate(parts.begin(), parts.end(), 0.0);
  for (double& part : parts) part *= unit;
  if (std::isinf(thickness)) parts.back() = infinite_thickness;
  return parts;
}

RelatedPair cut(Dice& dice, RollingScene scene, int pieces) {
  leave_softening_out(scene);
  scene.thermal_sublayers = 1;  // those of the pieces would have other middles
  RollingScene other = scene;
  const double width = dice.log_uniform(0.1, 10) * estimate_contact(scene).half_width;
  const auto lower = static_cast<int>(scene.lower_layers.size());
  const int layer = dice.choice(1 + lower + static_cast<int>(scene.coating_layers.size()));
  if (layer == 0) {
    const std::vector<double> parts = cut_thickness(dice, scene.layer_thickness, width, pieces);
    other.layer_thickness = parts.front();
    BondedLayer piece = scene;
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
  return RelatedScenes{.one = scene, .other = known_scene(other), .exact = 1e-6};
}

/// Longest way of the body in a retardation time of any layer [m].
double longest_memory(const RollingScene& scene) {
  const ContactModel model(scene);
  double longest = 0;
  for (const ModelLayer* const layer : model.layers())
    if (!layer->creep.terms.empty()) longest = std::max(longest, layer->creep.terms.back().time);
  return scene.speed * longest * std::max(1.0, std::abs(model.flow));
}

/// A cylinder's coating is a ring, and flat to H/R: the same contact of a much larger one.
void make_larger(RollingScene& scene) {
  constexpr double larger = 1e5;
  scene.radius *= larger;
  if (scene.load) *scene.load /= larger;
}

}  // namespace

RelatedPair cut_in_two(Dice& dice, RollingScene scene) { return cut(dice, scene, 2); }
RelatedPair cut_in_five(Dice& dice, RollingScene scene) { return cut(dice, scene, 5); }

/// Without friction only the sum of what both sides yield counts.
RelatedPair exchanged(Dice& dice, RollingScene scene) {
  leave_heat_out(scene);
  leave_softening_out(scene);
  if (scene.method == Method::finite_strain) return {};
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
  static_cast<BondedLayer&>(other) = scene.coating_layers.front();
  other.lower_layers.assign(scene.coating_layers.begin() + 1, scene.coating_layers.end());
  other.coating_layers = {static_cast<const BondedLayer&>(scene)};
  other.coating_layers.insert(other.coating_layers.end(), scene.lower_layers.begin(), scene.lower_layers.end());
  // Whose slope the pressure pushes against decides how the resistance is shared by force and torque.
  return RelatedScenes{.one = scene,
                       .other = known_scene(other),
                       .exact = ring ? 1e-5 : 1e-7,
                       .left_out = {"driving_force", "driving_torque"}};
}

/// Inertia of layers that weigh next to nothing for none.
RelatedPair weightless(Dice& dice, RollingScene scene) {
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
                       .other = known_scene(other),
                       .exact = ring ? 1e-5 : 1e-6,
                       .resistance = scene.tolerance.value_or(0),
                       .left_out = {"peak_shear_x", "peak_shear_y", "viscous_loss", "frictional_loss"}};
}

/// On elastic layers a cylinder that slides forwards everywhere is the mirror image of one that slides backwards. It
/// slides so where the creepage is larger than the strains along the surface, of about the approach over the depth.
RelatedPair mirrored(Dice& dice, RollingScene scene) {
  leave_heat_out(scene);
  leave_softening_out(scene);
  scene.skew_angle.reset();
  scene.camber_angle = scene.pivot = 0;
  for (MaterialInputs* const layer : layer_materials(scene)) {
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
                       .other = known_scene(other),
                       .exact = 1e-6,
                       .mirrored = true,
                       .left_out = {"rolling_resistance", "rotation_ratio", "viscous_loss", "frictional_loss"}};
}

RelatedPair turned_back(Dice&, RollingScene scene) {
  if (is_straight(scene)) return {};
  RollingScene other = scene;
  for (std::optional<double>* const turning : {&other.skew_angle, &other.axial_force, &other.lateral_force})
    if (*turning) **turning *= -1;
  other.camber_angle *= -1;
  other.pivot *= -1;
  std::reverse(other.profile_places.begin(), other.profile_places.end());
  std::reverse(other.profile_heights.begin(), other.profile_heights.end());
  for (double& place : other.profile_places) place *= -1;
  return RelatedScenes{.one = scene, .other = known_scene(other), .exact = 1e-7, .strict = true, .turned_back = true};
}

RelatedPair long_period(Dice&, RollingScene scene) {
  leave_heat_out(scene);
  leave_softening_out(scene);
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
  return RelatedScenes{.one = scene, .other = known_scene(other), .exact = 2e-3};
}

RelatedPair closed_ring(Dice& dice, RollingScene scene) {
  leave_heat_out(scene);
  leave_softening_out(scene);
  constexpr double nodes = 40, waves_per_cell = 24;
  const double turn = 2 * std::numbers::pi * scene.radius;
  if (scene.coating_layers.empty()) {
    BondedLayer coating;
    static_cast<MaterialInputs&>(coating) = scene;
    coating.layer_thickness = rounded(dice.log_uniform(0.03, 0.4) * scene.radius);
    scene.coating_layers = {coating};
  }
  // The other bodies' way over the foundation is none of the ring's: it remembers nothing, and they are far apart.
  if (!scene.static_shear_modulus) return {};
  scene.material = MaterialModel::elastic;
  scene.lower_layers.clear();
  scene.layer_thickness = std::min(scene.layer_thickness, turn / 60);
  scene.inertia = Inertia::off;
  scene.tolerance.reset();
  scene.skew_angle.reset();
  if (!on_grid(scene.method)) scene.method = Method::newton;
  const double half_width = estimate_contact(scene).half_width;
  if (constexpr double widest = 0.3; half_width > widest * scene.radius) return {};
  scene.spacing = rounded(2 * half_width / nodes);
  RollingScene other = scene;
  other.period = turn;
  other.series_terms = static_cast<int>(std::min(waves_per_cell * turn / *scene.spacing, 4e5));
  return RelatedScenes{.one = scene, .other = known_scene(other), .exact = 3e-3};
}

RelatedPair deep_layer(Dice&, RollingScene scene) {
  leave_heat_out(scene);
  leave_softening_out(scene);
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
  return RelatedScenes{.one = scene,
                       .other = known_scene(other),
                       .exact = slips ? 1e-3 : 1e-5,
                       .left_out = {"approach", "deflection", "peak_deflection"}};
}

}  // namespace rollres
