#include "tests/fuzz/random_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <type_traits>
#include <vector>

#include "core/messages/message_text.hpp"
#include "core/surface/scene_rules.hpp"

namespace rollres {

namespace {

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : generator_(seed) {}
  double unit() { return static_cast<double>(generator_() >> 11) * 0x1p-53; }
  bool one_in(double count) { return unit() * count < 1; }
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(generator_() % count); }

 private:
  std::mt19937_64 generator_;
};

/// What an ordinary scene has in this unit; its own value says nothing where it is 0 or absent.
double usual(std::string_view unit) {
  if (unit == "m") return 0.01;
  if (unit == "Pa") return 1e6;
  if (unit == "N" || unit == "N.m") return 1e3;
  if (unit == "K") return 300;
  if (unit == "J/mol") return 5e4;
  if (unit == "kg/m3") return 1e3;
  if (unit == "byte") return 1e9;
  return 1;
}

double random_number(Dice& dice, const Quantity& quantity, double now) {
  const double middle = now != 0 && std::isfinite(now) ? now : usual(quantity.unit);
  double value = middle * std::pow(10.0, 12 * dice.unit() - 6);
  if (dice.one_in(20)) value = quantity.range.lowest;
  if (dice.one_in(40) && quantity.range.infinity_allowed) return INFINITY;
  if (dice.one_in(10) && quantity.range.lowest < 0) value = -value;
  return std::clamp(value, std::max(quantity.range.lowest, -1e300), std::min(quantity.range.highest, 1e300));
}

/// Changes about one in `every` inputs of a scene or of a layer, lists all to the same length.
class Change {
 public:
  Change(Dice& dice, double every) : dice_(dice), every_(every), length_(dice.one_in(30) ? 300 : 1 + dice.below(8)) {}

  void operator()(const Quantity& quantity, double& value) {
    if (dice_.one_in(every_)) value = random_number(dice_, quantity, value);
  }
  void operator()(const Quantity& quantity, int& value) {
    if (dice_.one_in(every_)) value = static_cast<int>(random_number(dice_, quantity, value));
  }
  void operator()(const Quantity& quantity, std::optional<double>& value) {
    if (!dice_.one_in(every_)) return;
    if (value && dice_.one_in(4))
      value.reset();
    else if (value || dice_.one_in(4))
      value = random_number(dice_, quantity, value.value_or(0));
  }
  void operator()(const Quantity& quantity, std::vector<double>& values) {
    values.resize(length_);
    for (double& value : values) value = random_number(dice_, quantity, 0);
  }
  void operator()(const Quantity&, BondedLayers& layers) {
    for (layers.clear(); dice_.one_in(5);) {
      BondedLayer layer;
      layer.layer_thickness = 0.002;
      layer.static_shear_modulus = 1e6;
      layer.stiffening = 1;
      layer.creep_time = 0.1;
      visit_layer_inputs(layer, Change(dice_, every_));
      layers.push_back(layer);
    }
  }
  template <class Choice>
  requires std::is_enum_v<Choice>
  void operator()(const Quantity&, Choice& choice) {
    if (dice_.one_in(every_)) choice = static_cast<Choice>(dice_.below(ChoiceNames<Choice>::names.size()));
  }

 private:
  Dice& dice_;
  double every_;
  std::size_t length_;
};

/// An ordinary scene: the paper's.
RollingScene ordinary() {
  RollingScene scene;
  scene.radius = 0.02;
  scene.layer_thickness = 0.005;
  scene.static_shear_modulus = 3e6;
  scene.stiffening = 1;
  scene.creep_time = 0.25;
  scene.speed = 0.05;
  scene.load = 300;
  scene.friction_coefficient = 0.2;
  return scene;
}

/// Puts the input that a line "key = value: rule" or "key is missing: rule" names back to what it is in `sound`, or
/// gives it a number if it is missing there too.
void mend(RollingScene& scene, RollingScene sound, const std::string& line, Dice& dice) {
  const std::string key = line.substr(0, line.find_first_of(" :[."));
  visit_inputs(scene, [&](const Quantity& quantity, auto& value) {
    if (quantity.key != key) return;
    visit_inputs(sound, [&](const Quantity& other, const auto& kept) {
      if constexpr (std::is_same_v<std::decay_t<decltype(kept)>, std::decay_t<decltype(value)>>)
        if (other.key == key) value = kept;
    });
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::optional<double>>)
      if (line.find(" is missing: ") != std::string::npos) value = random_number(dice, quantity, 0);
  });
}

}  // namespace

RollingScene random_scene(std::uint64_t seed) {
  Dice dice(seed);
  for (;;) {
    RollingScene scene = ordinary();
    visit_inputs(scene, Change(dice, dice.one_in(2) ? 2 : 6));
    scene.time_limit.reset();
    scene.memory_limit.reset();
    for (int tries = 0; tries < 30; ++tries) {
      const std::vector<std::string> broken = check(scene);
      if (broken.empty()) return scene;
      mend(scene, ordinary(), broken[dice.below(broken.size())], dice);
    }
  }
}

std::string what_is_wrong(const RollingScene& scene, const RollingSolution& solution) {
  if (solution.status != Status::converged) return solution.reason.empty() ? "no answer and no reason" : "";
  std::string wrong;
  const auto require = [&](bool holds, const auto&... said) {
    if (!holds) wrong += message_text(said..., "; ");
  };
  const double resistance = solution.rolling_resistance, error = solution.rolling_resistance_error;
  require(std::isfinite(resistance) && std::isfinite(solution.load), "R_r ", resistance, ", load ", solution.load);
  require(solution.law_violation <= 1e-8, "law_violation ", solution.law_violation);
  require(solution.error_estimate >= 0 && error >= 0, "error_estimate ", solution.error_estimate);
  require(solution.contact_nodes > 2 || !on_grid(solution.method), solution.contact_nodes, " nodes");
  const double reach = std::max(std::abs(solution.leading_edge), std::abs(solution.trailing_edge));
  // Of an elastic body the resistance is rounding of the load's lever.
  if (!(std::abs(resistance) > 1e-3 * solution.load * reach / scene.radius)) return wrong;
  require(solution.energy_residual <= std::max(0.01, solution.error_estimate), "energy_residual ",
          solution.energy_residual, " with error_estimate ", solution.error_estimate);
  require(resistance >= -error || scene.kinematics == Kinematics::printed, "gains power: R_r ", resistance);
  return wrong;
}

}  // namespace rollres
