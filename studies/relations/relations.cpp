#include "studies/relations/relations.hpp"

#include <array>
#include <stdexcept>
#include <utility>

#include "core/estimate/grid_choice.hpp"
#include "core/model/absent_outputs.hpp"
#include "core/model/scene_rules.hpp"
#include "studies/relations/relation_kinds.hpp"

namespace rollres {

namespace {

RelatedPair tolerances(Dice&, RollingScene scene) {
  if (scene.method == Method::active_set || scene.method == Method::newton_dense) return {};
  const bool sphere = dimension_of(scene.indenter) == 3;
  scene.spacing.reset();
  scene.tolerance = sphere ? 1e-2 : 1e-3;
  RollingScene other = scene;
  other.tolerance = sphere ? 1e-3 : scene.method == Method::automatic ? 1e-6 : 1e-4;
  return RelatedScenes{.one = scene,
                       .other = known_scene(other),
                       .resistance = *scene.tolerance,
                       .left_out = {"peak_shear_x", "peak_shear_y"}};
}

constexpr std::array<Relation, 17> all_relations{{
    {"cut in two", "a layer, or a coating, as two of the same material", cut_in_two},
    {"cut in five", "the same as five", cut_in_five},
    {"term split", "a Prony term as two of half its modulus", term_split},
    {"term unseen", "a Prony term more that the contact cannot see", term_unseen},
    {"other words", "the same material by other inputs", other_words},
    {"scaled", "lengths, moduli and times in other units", all_scaled},
    {"speed and memories", "a speed times a number, all times over it", speed_scaled},
    {"whole width", "loads and torques of a cylinder's whole width for those per metre", whole_width, false},
    {"given back",
     "load given, approach found and given in its place, or the other way round; skew and axial force likewise",
     given_back},
    {"exchanged", "without friction, the body's coating for what lies below", exchanged},
    {"weightless", "inertia of layers that weigh next to nothing for none", weightless},
    {"mirrored", "on elastic layers, sliding forwards for sliding backwards", mirrored, false},
    {"turned back", "skew, camber and pivot to the other side", turned_back},
    {"long period", "bodies far apart for a single one", long_period, false},
    {"closed ring", "a coating that comes round after a turn for bodies a turn apart", closed_ring, false},
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

/// A straight tread with shoulders, which one end may have higher than the other.
void give_profile(Dice& dice, RollingScene& scene) {
  scene.indenter = Indenter::profile;
  const double tread = scene.radius * dice.log_uniform(0.05, 0.4), shoulder = scene.radius * dice.log_uniform(0.2, 1);
  const double cone = dice.choice(2) == 0 ? 0 : dice.signed_log_uniform(1e-3, 0.05);
  constexpr int points = 20;  // on a shoulder
  constexpr double part = 0.85;
  const auto add = [&](double along, double height) {
    scene.profile_places.push_back(rounded(along));
    scene.profile_heights.push_back(rounded(height + cone * (along + tread + part * shoulder)));
  };
  const auto arc = [&](int i) {
    const double t = part * i / points;
    return std::pair{tread + t * shoulder, shoulder * (1 - std::sqrt(1 - t * t))};
  };
  for (int i = points; i > 0; --i) add(-arc(i).first, arc(i).second);
  for (int i = -2; i <= 2; ++i) add(0.5 * i * tread, 0);
  for (int i = 1; i <= points; ++i) add(arc(i).first, arc(i).second);
}

/// Turns the axle or the path of one in four of those bodies that may be turned, and gives one ball in five a crown or
/// a profile.
void draw_turning(Dice& dice, RollingScene& scene) {
  const bool solved =
      scene.method == Method::automatic || scene.method == Method::newton || scene.method == Method::newton_dense;
  if (!solved || scene.kinematics == Kinematics::printed) return;
  if (dimension_of(scene.indenter) == 2) {
    if (dice.choice(4) == 0) scene.skew_angle = rounded(dice.signed_log_uniform(1e-4, 0.3));
    return;
  }
  const int shape = dice.choice(10);
  if (shape == 0) give_profile(dice, scene);
  if (shape == 1) {
    scene.indenter = Indenter::roller;
    scene.transverse_radius = rounded(scene.radius * dice.log_uniform(0.4, 5));
    scene.crown = dice.choice(2) == 0 ? Crown::circle : Crown::ellipse;
  }
  if (!scene.coating_layers.empty() || dice.choice(4) != 0) return;
  const int turning = dice.choice(scene.indenter == Indenter::sphere ? 4 : 2);
  if (turning == 0 || turning == 3) scene.skew_angle = rounded(dice.signed_log_uniform(1e-4, 0.2));
  if (turning == 1 || turning == 3) scene.camber_angle = rounded(dice.signed_log_uniform(1e-3, 0.8));
  if (turning >= 2) scene.pivot = rounded(dice.signed_log_uniform(1e-3, 0.3) / scene.radius);
}

/// Bounds the shear of one in six scenes with friction, somewhere in the contact or nowhere.
void draw_traction_limit(Dice& dice, RollingScene& scene) {
  if (scene.friction_coefficient == 0 || scene.method == Method::active_set || dice.choice(6) != 0) return;
  const ContactEstimate estimate = estimate_contact(scene);
  const double a = estimate.half_width, area = dimension_of(scene.indenter) == 3 ? 3.14 * a * a : 2 * a;
  scene.traction_limit = rounded(scene.friction_coefficient * estimate.load / area * dice.log_uniform(0.05, 2));
}

/// Puts a given pressure in place of one ball in eight, of about the size of its contact.
void draw_given_pressure(Dice& dice, RollingScene& scene) {
  if (dimension_of(scene.indenter) == 2 || dice.choice(8) != 0 || !scene.load) return;
  RollingScene given;
  static_cast<MaterialInputs&>(given) = scene;
  given.layer_thickness = scene.layer_thickness;
  given.layer_density = scene.layer_density;
  given.lower_layers = scene.lower_layers;
  given.inertia = scene.inertia;
  given.speed = scene.speed;
  given.load = scene.load;
  given.tolerance = scene.tolerance;
  given.indenter = Indenter::pressure;
  given.radius = rounded(estimate_contact(scene).half_width * dice.log_uniform(0.3, 3));
  given.transverse_radius = rounded(given.radius * dice.log_uniform(0.2, 5));
  given.pressure_shape = static_cast<PressureShape>(dice.choice(2));
  given.pressure_distribution = static_cast<PressureDistribution>(dice.choice(2));
  given.traction_coefficient = dice.choice(2) == 0 ? 0 : rounded(dice.signed_log_uniform(0.05, 1));
  given.deflection_places_x = {rounded(given.radius * dice.signed_log_uniform(0.1, 4))};
  given.deflection_places_y = {rounded(given.radius * dice.signed_log_uniform(0.1, 4))};
  scene = std::move(given);
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
  draw_turning(dice, scene);
  draw_traction_limit(dice, scene);
  draw_given_pressure(dice, scene);
  return scene;
}

}  // namespace

void leave_friction_out(RollingScene& scene) {
  scene.friction_coefficient = 0;
  scene.drive = Drive::top_force;
  scene.driving_torque.reset();
  scene.rotation_ratio.reset();
}

std::span<const Relation> relations() { return all_relations; }

RelatedScenes related_scenes(const Relation& relation, Indenter indenter, std::uint64_t seed, std::size_t number,
                             Spectra spectra) {
  RollingSolution found;  // an answer that gives the other scene something to be checked with
  found.load = found.approach = found.axial_force = found.lateral_force = 1e-4;
  std::uint64_t named = mixed(mixed(seed) + number);
  for (const char letter : relation.name) named = mixed(named + static_cast<unsigned char>(letter));
  constexpr std::uint64_t most_attempts = 10'000;  // a hundred are seldom needed
  for (std::uint64_t attempt = 0; attempt < most_attempts; ++attempt) {
    const std::uint64_t lot = mixed(named + attempt);
    Dice dice(lot);
    const RollingScene scene = scene_to_relate(dice, stability_scene(indenter, lot, number, spectra));
    if (!check(scene).empty()) continue;
    RelatedPair scenes = relation.scenes(dice, scene);
    if (scenes && check(scenes->one).empty() && check(scenes->other(found)).empty()) return std::move(*scenes);
  }
  throw std::logic_error("no random scene fits the relation " + std::string(relation.name));
}

}  // namespace rollres
