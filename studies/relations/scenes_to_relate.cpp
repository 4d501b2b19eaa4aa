#include "studies/relations/scenes_to_relate.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "core/estimate/grid_choice.hpp"
#include "core/model/absent_outputs.hpp"
#include "core/model/contact_surface.hpp"
#include "core/scene/warmed_layers.hpp"
#include "studies/relations/relation_kinds.hpp"

namespace rollres {

namespace {

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

/// Warms the layers of one cylinder in eight, by about 0.5 to 50 K where a tenth of the load's lever is lost.
void draw_heat(Dice& dice, RollingScene& scene) {
  if (dimension_of(scene.indenter) == 3 || dice.choice(8) != 0) return;
  const bool belt = scene.coating_layers.empty();
  const ContactEstimate estimate = estimate_contact(scene);
  const double a = estimate.half_width,
               turn = belt ? a * dice.log_uniform(20, 2000) : 2 * std::numbers::pi * scene.radius;
  const double lost = 0.1 * estimate.load * a / scene.radius * scene.speed, thickness = warmed_thickness(scene);
  const double transfer = lost / turn / dice.log_uniform(0.5, 50), biot = dice.log_uniform(0.1, 30);
  const double peclet = dice.log_uniform(30, 1e5), conductivity = transfer * thickness / biot;
  const double capacity = conductivity * peclet * scene.radius / (scene.speed * thickness * thickness);
  scene.heat = Heat::on;
  if (belt) scene.turn_length = rounded(turn);
  scene.surface_heat_transfer = rounded(transfer);
  scene.thermal_conductivity = rounded(conductivity);
  scene.heat_capacity = rounded(capacity);
  scene.ambient_temperature = rounded(dice.uniform(273, 313));
  if (dice.choice(3) == 0) {
    scene.ground_effusivity = rounded(std::sqrt(conductivity * capacity) * dice.log_uniform(0.1, 10));
    if (dice.choice(2) == 0) scene.ground_temperature = rounded(dice.uniform(273, 313));
  }
  const int core = dice.choice(4);
  if (core == 0) scene.core_temperature = rounded(dice.uniform(273, 323));
  if (core <= 1) scene.core_heat_transfer = rounded(transfer * dice.log_uniform(0.1, 10));
  if (core == 2) scene.core = CoreHeat::insulated;
  if (dice.choice(3) == 0) scene.thermal_sublayers = 2 + dice.choice(4);
  for (MaterialInputs* const layer : layer_materials(scene)) {
    layer->temperature.reset();
    if (layer->reference_temperature || dice.choice(3) == 0) continue;
    layer->reference_temperature = 293;
    layer->activation_energy = dice.log_uniform(2e4, 2e5);
  }
}

/// Lets about half of the layers of one scene in eight soften with the strain.
void draw_softening(Dice& dice, RollingScene& scene) {
  if (dice.choice(8) != 0) return;
  const double strain = strain_estimate(scene);
  for (MaterialInputs* const layer : layer_materials(scene)) {
    if (layer->material == MaterialModel::elastic || dice.choice(2) == 0) continue;
    layer->payne_drop = rounded(dice.uniform(0.05, 0.6));
    layer->payne_strain = rounded(strain * dice.log_uniform(0.1, 10));
    layer->payne_exponent = rounded(dice.uniform(0.3, 1));
    layer->payne_loss_peak = dice.log_uniform(1, 1.5);
  }
}

/// Takes the strains of one cylinder in sixteen as they are, on a mesh; what a coated one rolls on is rigid.
void draw_finite_strain(Dice& dice, RollingScene& scene) {
  if (dimension_of(scene.indenter) == 3 || dice.choice(16) != 0) return;
  scene.method = Method::finite_strain;
  scene.inertia = Inertia::off;
  scene.tolerance.reset();
  scene.spacing.reset();
  if (scene.coating_layers.empty()) return;
  static_cast<MaterialInputs&>(scene) = MaterialInputs{};
  scene.material = MaterialModel::elastic;
  constexpr double rigid = 1e17;
  scene.static_shear_modulus = rigid;
}

/// Puts a given pressure in place of one ball in eight, of about the size of its contact.
void draw_given_pressure(Dice& dice, RollingScene& scene) {
  if (dimension_of(scene.indenter) == 2 || dice.choice(8) != 0 || !scene.load) return;
  RollingScene given;
  static_cast<BondedLayer&>(given) = scene;
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

}  // namespace

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
  draw_heat(dice, scene);
  draw_softening(dice, scene);
  draw_finite_strain(dice, scene);
  draw_given_pressure(dice, scene);
  return scene;
}

double strain_estimate(const RollingScene& scene) {
  const double half_width = estimate_contact(scene).half_width;
  return half_width * half_width / scene.radius / std::min(half_width, total_thickness(scene));
}

void leave_heat_out(RollingScene& scene) {
  if (scene.heat == Heat::on) scene = at_temperature(scene, *scene.ambient_temperature);
}

void leave_softening_out(RollingScene& scene) {
  for (MaterialInputs* const layer : layer_materials(scene)) {
    layer->payne_drop = 0;
    layer->payne_strain.reset();
    layer->payne_loss_peak = 1;
  }
}

void leave_friction_out(RollingScene& scene) {
  scene.friction_coefficient = 0;
  scene.drive = Drive::top_force;
  scene.driving_torque.reset();
  scene.rotation_ratio.reset();
}

}  // namespace rollres
