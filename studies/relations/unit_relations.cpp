#include "studies/relations/relation_kinds.hpp"

#include <array>
#include <cmath>

#include "core/model/absent_outputs.hpp"
#include "core/model/scene_rules.hpp"
#include "core/scene/scene_input.hpp"

namespace rollres {

namespace {

/// Of one scene in four the inside as well, where both answers are to be the same.
void look_inside(Dice& dice, RollingScene& scene) {
  if (dice.choice(4) != 0) return;
  scene.interior = Interior::on;
  if (!check(scene).empty()) scene.interior = Interior::off;
}

double power_of_two(Dice& dice, int most) { return std::ldexp(1.0, dice.choice(2 * most + 1) - most); }

/// Equal but for rounding of logarithms of times, which memories many decades apart amplify: up to 8e-7 of an approach.
RelatedPair scaled(Dice& dice, RollingScene scene, const UnitFactors& factors) {
  look_inside(dice, scene);
  RelatedScenes pair{.one = scene, .other = known_scene(in_units(scene, factors)), .factors = factors};
  pair.exact = 1e-6;
  pair.strict = true;
  return pair;
}

}  // namespace

RelatedPair all_scaled(Dice& dice, RollingScene scene) {
  const UnitFactors factors{power_of_two(dice, 8), power_of_two(dice, 12), power_of_two(dice, 16)};
  return scaled(dice, std::move(scene), factors);
}

RelatedPair speed_scaled(Dice& dice, RollingScene scene) {
  const UnitFactors factors{1, 1, power_of_two(dice, 12)};
  return scaled(dice, std::move(scene), factors);
}

/// Loads and torques of a whole cylinder are those per metre times its width. A power of 2, as above.
RelatedPair whole_width(Dice& dice, RollingScene scene) {
  const double width = power_of_two(dice, 6);
  look_inside(dice, scene);
  RollingScene other = scene;
  other.width = width;
  for (std::optional<double>* const given : {&other.load, &other.driving_torque, &other.axial_force})
    if (*given) **given *= width;
  RelatedScenes pair{.one = scene, .other = known_scene(other), .width = width};
  pair.strict = true;
  return pair;
}

RelatedPair given_back(Dice&, RollingScene scene) {
  if (scene.skew_angle && scene.friction_coefficient > 0) {
    const auto other = [scene](const RollingSolution& found) {
      RollingScene back = scene;
      // Where all slides, forces at two skews may be the same.
      constexpr double tells = 0.98;
      const bool line = dimension_of(scene.indenter) == 2;
      const double force = line ? found.axial_force : found.lateral_force;
      if (std::abs(force) > tells * scene.friction_coefficient * found.load) return back;
      back.skew_angle.reset();
      (line ? back.axial_force : back.lateral_force) = force;
      return back;
    };
    return RelatedScenes{.one = scene, .other = other, .sensitivity = 5};
  }
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

double UnitFactors::of(std::string_view unit) const {
  struct Dimension {
    std::string_view unit;
    double length, modulus, time;
  };
  static constexpr std::array<Dimension, 18> dimensions{{{"m", 1, 0, 0},
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
                                                         {"W/m/K", 2, 1, -1},
                                                         {"W/m2/K", 1, 1, -1},
                                                         {"J/m3/K", 0, 1, 0},
                                                         {"W.s0.5/m2/K", 1, 1, -0.5},
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

}  // namespace rollres
