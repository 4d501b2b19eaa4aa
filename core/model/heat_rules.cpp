#include "core/model/heat_rules.hpp"

#include <cmath>

#include "core/material/material_scale.hpp"
#include "core/messages/message_text.hpp"
#include "core/model/scene_rules.hpp"
#include "core/scene/warmed_layers.hpp"

namespace rollres {

namespace {

using HeatLines = std::vector<std::string>;

/// "coating_layers[0]." before the keys of a warmed layer.
std::string warmed_owner(const RollingScene& scene, std::size_t place) {
  if (!scene.coating_layers.empty()) return message_text("coating_layers[", place, "].");
  return place == 0 ? std::string() : message_text("lower_layers[", place - 1, "].");
}

void check_motion(const RollingScene& scene, HeatLines& lines) {
  if (dimension_of(scene.indenter) == 3)
    lines.push_back("heat = on: not of a sphere, which warms its layer in a narrow track and not evenly across");
  else if (const std::string why = why_no_interior(scene); !why.empty())
    lines.push_back("heat = on: " + why);
  if (scene.kinematics == Kinematics::printed)
    lines.push_back("heat = on: only with kinematics \"consistent\", by which the power balances");
  if (scene.drive == Drive::rotation && scene.rotation_ratio && !(*scene.rotation_ratio > 0))
    lines.push_back(
        message_text("rotation_ratio = ", *scene.rotation_ratio,
                     ": must be > 0 with heat \"on\": a body that does not turn forwards is not evenly warm"));
}

void check_turn(const RollingScene& scene, HeatLines& lines) {
  if (!scene.coating_layers.empty()) {
    if (scene.turn_length)
      lines.push_back(message_text("turn_length = ", *scene.turn_length,
                                   ": only of a belt; a coating comes round after 2 π times the radius"));
    return;
  }
  if (!scene.turn_length)
    lines.push_back(
        "turn_length is missing: heat \"on\" needs it without coating_layers: the length after which the "
        "layers under the body meet it again (m)");
  if (std::isinf(warmed_thickness(scene)))
    lines.push_back(message_text(std::isinf(scene.layer_thickness) ? "layer_thickness" : "lower_layers",
                                 " = \"infinite\": must be finite with heat \"on\" and no coating_layers"));
}

void check_exits(const RollingScene& scene, HeatLines& lines) {
  const auto need = [&](bool given, const char* key, const char* unit) {
    if (!given) lines.push_back(message_text(key, " is missing: heat \"on\" needs it (", unit, ")"));
  };
  need(scene.thermal_conductivity.has_value(), "thermal_conductivity", "W/m/K");
  need(scene.surface_heat_transfer.has_value(), "surface_heat_transfer", "W/m2/K");
  need(scene.ambient_temperature.has_value(), "ambient_temperature", "K");
  if (scene.ground_effusivity > 0 && !scene.heat_capacity)
    lines.push_back("heat_capacity is missing: a ground_effusivity needs it (J/m3/K)");
  if (scene.ground_effusivity == 0 && scene.ground_temperature)
    lines.push_back(
        message_text("ground_temperature = ", *scene.ground_temperature, ": needs a ground_effusivity > 0"));
  const bool cooled = scene.core_temperature || scene.core_heat_transfer;
  if (scene.core == CoreHeat::insulated && cooled) {
    const bool fixed = scene.core_temperature.has_value();
    lines.push_back(message_text(fixed ? "core_temperature = " : "core_heat_transfer = ",
                                 fixed ? *scene.core_temperature : *scene.core_heat_transfer,
                                 ": not with core \"insulated\""));
  }
  if (scene.surface_heat_transfer == 0.0 && scene.ground_effusivity == 0 && !cooled)
    lines.push_back(
        "surface_heat_transfer = 0: heat has no way out: give a ground_effusivity or a core_temperature, too");
}

/// The materials at each temperature around them, as lines "ambient_temperature = value: rule".
void check_laws_of_shift(const RollingScene& scene, HeatLines& lines) {
  const std::vector<const MaterialInputs*> layers = warmed_layers(scene);
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const std::string owner = warmed_owner(scene, i);
    if (layers[i]->temperature) {
      lines.push_back(message_text<6>(owner, "temperature = ", *layers[i]->temperature,
                                      ": not with heat \"on\", which finds it: give ambient_temperature"));
      continue;
    }
    if (!scene.ambient_temperature || !has_shift(*layers[i])) continue;
    for (const auto& [key, temperature] : surroundings(scene)) {
      MaterialInputs there = *layers[i];
      there.temperature = temperature;
      const HeatLines broken = check_material(there);
      for (const std::string& line : broken) {
        const bool own = line.starts_with("temperature");
        lines.push_back(own ? std::string(key) + line.substr(std::string_view("temperature").size()) : owner + line);
      }
      constexpr Range sensible{.lowest = 1e-30, .highest = 1e30};
      if (const double shift = broken.empty() ? time_shift(there) : 1; !sensible.contains(shift))
        lines.push_back(
            message_text(key, " = ", temperature, ": multiplies all times by ", shift, ", which ", sensible.rule()));
    }
  }
}

}  // namespace

std::vector<std::string> broken_heat_rules(const RollingScene& scene, bool in_range) {
  HeatLines lines;
  if (scene.heat == Heat::off) return lines;
  check_motion(scene, lines);
  check_turn(scene, lines);
  check_exits(scene, lines);
  if (in_range) check_laws_of_shift(scene, lines);
  return lines;
}

}  // namespace rollres
