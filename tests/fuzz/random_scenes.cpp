#include "tests/fuzz/random_scenes.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <type_traits>
#include <vector>

#include "core/messages/message_text.hpp"
#include "core/model/scene_rules.hpp"
#include "studies/evidence/random_material.hpp"

namespace rollres {

namespace {

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

double random_number(Dice& dice, const Quantity& quantity, double now, double decades) {
  const double middle = now != 0 && std::isfinite(now) ? now : usual(quantity.unit);
  // Shift laws allow few temperatures beyond those of rubbers.
  if (quantity.unit == "K" && !dice.one_in(4)) decades = std::min(decades, 0.5);
  double value = middle * std::pow(10.0, decades * (dice.unit() - 0.5));
  if (dice.one_in(20)) value = quantity.range.lowest;
  if (dice.one_in(40) && quantity.range.infinity_allowed) return INFINITY;
  if (dice.one_in(10) && quantity.range.lowest < 0) value = -value;
  return std::clamp(value, std::max(quantity.range.lowest, -1e300), std::min(quantity.range.highest, 1e300));
}

/// Whether a material cannot be without this list; the others are drawn seldom.
bool is_needed(std::string_view list) {
  for (std::size_t i = 0; i < ChoiceNames<MaterialModel>::names.size(); ++i)
    if (find_name(needed_inputs(static_cast<MaterialModel>(i)), list) >= 0) return true;
  return false;
}

/// A further layer as it is before it is changed.
BondedLayer ordinary_layer() {
  BondedLayer layer;
  layer.layer_thickness = 0.002;
  layer.static_shear_modulus = 1e6;
  layer.stiffening = 1;
  layer.creep_time = 0.1;
  return layer;
}

/// Changes about one in `every` inputs of a scene or of a layer by so many decades, lists all to the same length.
class Change {
 public:
  Change(Dice& dice, double every, double decades)
      : dice_(dice),
        every_(every),
        decades_(decades),
        length_(dice.one_in(30) ? 300 : 1 + dice.below(8)),
        all_lists_(dice.one_in(6)) {}

  void operator()(const Quantity& quantity, double& value) {
    if (dice_.one_in(every_)) value = number(quantity, value);
  }
  void operator()(const Quantity& quantity, int& value) {
    if (dice_.one_in(every_)) value = static_cast<int>(number(quantity, value));
  }
  void operator()(const Quantity& quantity, std::optional<double>& value) {
    if (!dice_.one_in(every_)) return;
    if (value && dice_.one_in(4))
      value.reset();
    else if (value || dice_.one_in(4))
      value = number(quantity, value.value_or(0));
  }
  void operator()(const Quantity& quantity, std::vector<double>& values) {
    if (!all_lists_ && !is_needed(quantity.key)) return;
    values.resize(length_);
    for (double& value : values) value = number(quantity, 0);
  }
  void operator()(const Quantity&, BondedLayers& layers) {
    for (layers.clear(); dice_.one_in(5);) {
      layers.push_back(ordinary_layer());
      visit_layer_inputs(layers.back(), Change(dice_, every_, decades_));
    }
  }
  template <class Choice>
  requires std::is_enum_v<Choice>
  void operator()(const Quantity&, Choice& choice) {
    if (dice_.one_in(every_)) choice = static_cast<Choice>(dice_.below(ChoiceNames<Choice>::names.size()));
  }

 private:
  double number(const Quantity& quantity, double now) { return random_number(dice_, quantity, now, decades_); }

  Dice& dice_;
  double every_, decades_;
  std::size_t length_;
  bool all_lists_;
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

/// Whether a key stands in a text as a whole word.
bool names(const std::string& text, std::string_view key) {
  const auto in_word = [&](std::size_t at) {
    return at < text.size() && (std::isalnum(static_cast<unsigned char>(text[at])) || text[at] == '_');
  };
  for (std::size_t at = text.find(key); at != std::string::npos; at = text.find(key, at + 1))
    if ((at == 0 || !in_word(at - 1)) && !in_word(at + key.size())) return true;
  return false;
}

/// Mends an input that breaks a rule: a choice or a number becomes what it is in `sound`, an optional one comes or
/// goes, a list is sorted or, sorted already, goes.
class Mend {
 public:
  explicit Mend(Dice& dice) : dice_(dice) {}

  void operator()(const Quantity& quantity, std::optional<double>& value, const std::optional<double>&) {
    if (value)
      value.reset();
    else
      value = random_number(dice_, quantity, 0, 12);
  }
  void operator()(const Quantity&, std::vector<double>& values, const std::vector<double>&) {
    if (std::is_sorted(values.begin(), values.end()))
      values.clear();
    else
      std::sort(values.begin(), values.end());
  }
  template <class Value>
  void operator()(const Quantity&, Value& value, const Value& sound) {
    value = sound;
  }

 private:
  Dice& dice_;
};

/// Mends one of the inputs whose keys stand in a line "key = value: rule" or "key is missing: rule".
/// @param visit  visit_inputs or visit_layer_inputs
template <class Inputs, class Visit>
void mend(Inputs& inputs, Inputs sound, const std::string& line, Dice& dice, const Visit& visit) {
  std::vector<std::string_view> named;
  visit(inputs, [&](const Quantity& quantity, const auto&) {
    if (names(line, quantity.key)) named.push_back(quantity.key);
  });
  if (named.empty()) return;
  const std::string_view key = named[dice.below(named.size())];
  visit(inputs, [&](const Quantity& quantity, auto& value) {
    if (quantity.key != key) return;
    visit(sound, [&](const Quantity& other, auto& kept) {
      if constexpr (std::is_same_v<decltype(kept), decltype(value)>)
        if (other.key == key) Mend{dice}(quantity, value, kept);
    });
  });
}

void mend(RollingScene& scene, const std::string& line, Dice& dice) {
  for (BondedLayers* layers : {&scene.lower_layers, &scene.coating_layers}) {
    const std::string list = layers == &scene.lower_layers ? "lower_layers[" : "coating_layers[";
    if (!line.starts_with(list)) continue;
    const auto place = static_cast<std::size_t>(std::stoul(line.substr(list.size())));
    return mend(layers->at(place), ordinary_layer(), line.substr(line.find("].") + 2), dice,
                [](auto& layer, auto&& visitor) { visit_layer_inputs(layer, visitor); });
  }
  mend(scene, ordinary(), line, dice, [](auto& inputs, auto&& visitor) { visit_inputs(inputs, visitor); });
}

/// Leaves a straight single passage of a plain cylinder: what some chapters ask for, and seldom find by chance.
void roll_straight(RollingScene& scene) {
  scene.indenter = Indenter::cylinder;
  scene.inertia = Inertia::off;
  scene.period.reset();
  scene.transverse_radius.reset();
  scene.profile_places.clear();
  scene.profile_heights.clear();
  scene.traction_coefficient = 0;
  scene.deflection_places_x.clear();
  scene.deflection_places_y.clear();
  scene.lateral_force.reset();
  scene.axial_force.reset();
  scene.skew_angle.reset();
  scene.camber_angle = scene.pivot = 0;
}

/// Lets its loss warm the layers.
void warm(Dice& dice, RollingScene& scene) {
  roll_straight(scene);
  scene.kinematics = Kinematics::consistent;
  scene.heat = Heat::on;
  scene.thermal_conductivity = dice.log_uniform(0.1, 1);
  scene.heat_capacity = dice.log_uniform(1e6, 3e6);
  scene.surface_heat_transfer = dice.log_uniform(2, 200);
  scene.ambient_temperature = 250 + 80 * dice.log_uniform(0.1, 1);
  scene.turn_length.reset();
  if (scene.coating_layers.empty()) scene.turn_length = dice.log_uniform(0.1, 100);
  for (BondedLayers* const layers : {&scene.lower_layers, &scene.coating_layers})
    for (BondedLayer& layer : *layers) layer.temperature.reset();
  scene.temperature.reset();
}

/// Asks for the method that alone feels some of the inputs, and seldom finds all of its rules kept.
void strain_finitely(Dice& dice, RollingScene& scene) {
  roll_straight(scene);
  scene.method = Method::finite_strain;
  scene.interior = Interior::off;
  scene.adhesion_threshold = 0;
  scene.heat = Heat::off;
  if (!scene.coating_layers.empty() && dice.one_in(4)) scene.coating_layers.front().yeoh_second = 0.1;
  if (!scene.coating_layers.empty() && scene.static_shear_modulus) scene.static_shear_modulus = 1e17;
}

/// Puts a given pressure in place of the body.
void press(Dice& dice, RollingScene& scene) {
  const RollingScene plain;
  scene.indenter = Indenter::pressure;
  scene.friction_coefficient = scene.adhesion_threshold = scene.camber_angle = scene.pivot = 0;
  scene.drive = plain.drive;
  scene.kinematics = plain.kinematics;
  scene.method = dice.one_in(2) ? Method::convolution : Method::automatic;
  scene.heat = Heat::off;
  for (std::optional<double>* const of_body :
       {&scene.approach, &scene.traction_limit, &scene.driving_torque, &scene.rotation_ratio, &scene.skew_angle,
        &scene.axial_force, &scene.lateral_force, &scene.period, &scene.width})
    of_body->reset();
  scene.load = scene.load.value_or(300);
  scene.coating_layers.clear();
  scene.profile_places.clear();
  scene.profile_heights.clear();
  scene.deflection_places_y.resize(scene.deflection_places_x.size());
}

/// Gives the body a profile of three points.
void shape(Dice& dice, RollingScene& scene) {
  scene.indenter = Indenter::profile;
  scene.transverse_radius.reset();
  const double aside = scene.radius * dice.log_uniform(0.1, 3), high = scene.radius * dice.log_uniform(1e-3, 0.5);
  scene.profile_places = {-aside, 0, aside * dice.log_uniform(0.5, 2)};
  scene.profile_heights = {high, 0, high};
}

/// Materials with memories over many decades, in all layers.
void widen_spectra(Dice& dice, RollingScene& scene) {
  const double contact_time = 0.1 * scene.radius / scene.speed;
  const auto widen = [&](MaterialInputs& layer) {
    MaterialInputs wide;
    wide.poisson_ratio = layer.poisson_ratio;
    wide.static_shear_modulus = layer.static_shear_modulus.value_or(1e6);
    draw_material(dice, contact_time, wide);
    layer = wide;
  };
  widen(scene);
  for (BondedLayers* const layers : {&scene.lower_layers, &scene.coating_layers})
    for (BondedLayer& layer : *layers) widen(layer);
}

}  // namespace

RollingScene random_scene(std::uint64_t seed) {
  Dice dice(seed);
  for (;;) {
    RollingScene scene = ordinary();
    const double every = dice.one_in(2) ? 2 : 6, decades = dice.one_in(3) ? 1.5 : 12;
    visit_inputs(scene, Change(dice, every, decades));
    if (dice.one_in(4)) widen_spectra(dice, scene);
    if (dice.one_in(8))
      strain_finitely(dice, scene);
    else if (dice.one_in(16))
      warm(dice, scene);
    else if (dice.one_in(10))
      press(dice, scene);
    else if (dice.one_in(12))
      shape(dice, scene);
    scene.time_limit.reset();
    scene.memory_limit.reset();
    for (int tries = 0; tries < 60; ++tries) {
      const std::vector<std::string> broken = check(scene);
      if (broken.empty()) return scene;
      mend(scene, broken[dice.below(broken.size())], dice);
    }
  }
}

std::map<std::string, int> drawn_inputs(const RollingScene& scene) {
  std::map<std::string, int> drawn;
  const auto look = [&](const std::string& owner, const auto& inputs, const auto& plain, const auto& visit) {
    visit(inputs, [&](const Quantity& quantity, const auto& value) {
      const std::string key = owner + std::string(quantity.key);
      if constexpr (std::is_enum_v<std::decay_t<decltype(value)>>) {
        for (std::size_t i = 0; i < ChoiceNames<std::decay_t<decltype(value)>>::names.size(); ++i)
          drawn[key + "=" + std::string(ChoiceNames<std::decay_t<decltype(value)>>::names[i])] +=
              static_cast<std::size_t>(value) == i;
      } else {
        visit(plain, [&](const Quantity& other, const auto& kept) {
          if constexpr (std::is_same_v<decltype(kept), decltype(value)>)
            if (other.key == quantity.key) drawn[key] += value != kept;
        });
      }
    });
  };
  const auto visit_scene = [](auto& inputs, auto&& visitor) { visit_inputs(inputs, visitor); };
  const auto visit_layer = [](auto& inputs, auto&& visitor) { visit_layer_inputs(inputs, visitor); };
  look("", scene, ordinary(), visit_scene);
  for (const BondedLayer& layer : scene.lower_layers) look("lower_layers.", layer, ordinary_layer(), visit_layer);
  for (const BondedLayer& layer : scene.coating_layers) look("coating_layers.", layer, ordinary_layer(), visit_layer);
  drawn.erase("time_limit");
  drawn.erase("memory_limit");
  return drawn;
}

std::string what_is_wrong(const RollingScene& scene, const RollingSolution& solution) {
  if (solution.status != Status::converged) return solution.reason.empty() ? "no answer and no reason" : "";
  std::string wrong;
  const auto require = [&](bool holds, const auto&... said) {
    if (!holds) wrong += message_text(said..., "; ");
  };
  const double resistance = solution.rolling_resistance, error = solution.rolling_resistance_error;
  require(std::isfinite(resistance) && std::isfinite(solution.load), "R_r ", resistance, ", load ", solution.load);
  const bool body = scene.indenter != Indenter::pressure;  // there are no laws of contact without one
  require(!body || solution.law_violation <= 1e-8, "law_violation ", solution.law_violation);
  require(solution.error_estimate >= 0 && error >= 0, "error_estimate ", solution.error_estimate);
  require(solution.contact_nodes > 2 || !on_grid(solution.method), solution.contact_nodes, " nodes");
  const double reach = std::max(std::abs(solution.leading_edge), std::abs(solution.trailing_edge));
  // Of an elastic body the resistance is rounding of the load's lever.
  if (!(std::abs(resistance) > 1e-3 * solution.load * reach / scene.radius)) return wrong;
  require(!body || solution.energy_residual <= std::max(0.01, solution.error_estimate), "energy_residual ",
          solution.energy_residual, " with error_estimate ", solution.error_estimate);
  require(resistance >= -error || scene.kinematics == Kinematics::printed, "gains power: R_r ", resistance);
  return wrong;
}

}  // namespace rollres
