#include "core/surface/scene_rules.hpp"

#include <cmath>
#include <sstream>
#include <type_traits>

#include "core/messages/message_text.hpp"
#include "core/surface/contact_surface.hpp"

namespace rollres {

namespace {

/// The first rule of method spectral that the scene breaks, as a line "key = value: rule"; empty if none.
std::string broken_for_spectral(const RollingScene& scene) {
  if (scene.indenter == Indenter::sphere) return "method = spectral: only for a cylinder";
  if (scene.period) return message_text("period = ", *scene.period, ": not with method \"spectral\"");
  if (inertia_included(scene)) return "inertia = on: not with method \"spectral\"";
  // Half-spaces whose pressure moves the surface sideways oscillate at the edges of their sticking contact; and two of
  // them do so with memories of their own.
  const auto compressible = [](const MaterialInputs& material) { return material.poisson_ratio < 0.5; };
  const bool on_body = !scene.coating_layers.empty() && compressible(scene.coating_layers.front());
  if (!compressible(scene) && !on_body) return {};
  const std::string key = on_body ? "coating_layers[0].poisson_ratio" : "poisson_ratio";
  const double value = on_body ? scene.coating_layers.front().poisson_ratio : scene.poisson_ratio;
  if (scene.friction_coefficient > 0)
    return message_text(key, " = ", value, ": must be 0.5 with method \"spectral\" and friction");
  if (!scene.coating_layers.empty())
    return message_text(key, " = ", value, ": must be 0.5 with method \"spectral\" and a coating");
  return {};
}

}  // namespace

bool spectral_applies(const RollingScene& scene) { return broken_for_spectral(scene).empty(); }

Method resolved_method(const RollingScene& scene) {
  if (scene.method != Method::automatic) return scene.method;
  return spectral_applies(scene) && !scene.spacing ? Method::spectral : Method::newton;
}

std::vector<std::string> check(const RollingScene& scene) {
  std::vector<std::string> broken;
  auto complain = [&](std::string_view key, const auto& value, const std::string& rule) {
    std::ostringstream line;
    line << key << " = " << value << ": " << rule;
    broken.push_back(line.str());
  };
  auto missing = [&](std::string_view key, const std::string& rule) {
    broken.push_back(std::string(key) + " is missing: " + rule);
  };

  const auto check_range = [&](const std::string& owner, const Quantity& quantity, const auto& value) {
    using Value = std::decay_t<decltype(value)>;
    const std::string key = owner + std::string(quantity.key);
    if constexpr (std::is_arithmetic_v<Value>) {
      if (!quantity.range.contains(value)) complain(key, value, quantity.range.rule());
    } else if constexpr (std::is_same_v<Value, std::optional<double>>) {
      if (value && !quantity.range.contains(*value)) complain(key, *value, quantity.range.rule());
    } else if constexpr (std::is_same_v<Value, std::vector<double>>) {
      for (std::size_t i = 0; i < value.size(); ++i)
        if (!quantity.range.contains(value[i]))
          complain(key + "[" + std::to_string(i) + "]", value[i], quantity.range.rule());
    }
  };
  visit_inputs(scene, [&](const Quantity& quantity, const auto& value) { check_range("", quantity, value); });
  for (std::string& line : check_material(scene)) broken.push_back(std::move(line));
  const auto check_layers = [&](const std::string& list, const BondedLayers& layers) {
    for (std::size_t i = 0; i < layers.size(); ++i) {
      const std::string owner = list + "[" + std::to_string(i) + "].";
      visit_layer_inputs(layers[i],
                         [&](const Quantity& quantity, const auto& value) { check_range(owner, quantity, value); });
      for (const std::string& line : check_material(layers[i])) broken.push_back(owner + line);
    }
  };
  check_layers("lower_layers", scene.lower_layers);
  check_layers("coating_layers", scene.coating_layers);
  const bool in_range = broken.empty();

  double above = scene.layer_thickness;
  for (const BondedLayer& layer : scene.lower_layers) {
    if (std::isinf(above))
      complain("layer_thickness", "\"infinite\"", "only the last of the lower layers may be infinite");
    above = layer.layer_thickness;
  }
  double coating = 0;
  for (const BondedLayer& layer : scene.coating_layers) coating += layer.layer_thickness;
  if (coating >= scene.radius) complain("coating_layers", coating, "must be thinner than the radius, together");
  if (scene.load && scene.approach) complain("approach", *scene.approach, "give load or approach, not both");
  if (!scene.load && !scene.approach) missing("load", "give load or approach");
  if (scene.spacing && scene.tolerance) complain("tolerance", *scene.tolerance, "give spacing or tolerance, not both");
  if (scene.spacing && *scene.spacing > 0.2 * scene.radius)
    complain("spacing", *scene.spacing, "must be at most a fifth of the radius");
  if (scene.approach && *scene.approach >= scene.radius)
    complain("approach", *scene.approach, "must be less than the radius");
  const bool torque = scene.drive == Drive::torque, rotation = scene.drive == Drive::rotation;
  if (torque && !scene.driving_torque) missing("driving_torque", "drive \"torque\" needs it");
  if (!torque && scene.driving_torque) complain("driving_torque", *scene.driving_torque, "only with drive \"torque\"");
  if (rotation && !scene.rotation_ratio) missing("rotation_ratio", "drive \"rotation\" needs it");
  if (!rotation && scene.rotation_ratio)
    complain("rotation_ratio", *scene.rotation_ratio, "only with drive \"rotation\"");
  if (scene.approach && std::isinf(total_thickness(scene)) && scene.indenter == Indenter::cylinder)
    complain("approach", *scene.approach, "has no meaning for a cylinder on a half-space; give load");
  if (scene.method == Method::spectral) {
    if (std::string rule = in_range ? broken_for_spectral(scene) : ""; !rule.empty()) broken.push_back(std::move(rule));
  }
  if (scene.period && std::isinf(total_thickness(scene)))
    complain("period", *scene.period, "needs a layer of finite thickness");
  if (scene.inertia == Inertia::on) {
    if (const double number = in_range ? rayleigh_number(scene) : 0; number >= 1)
      complain("speed", scene.speed,
               "with inertia must be below that of Rayleigh waves on the layer at rest, " +
                   message_text(scene.speed / std::sqrt(number)) + " m/s");
    else if (in_range && layers_carry_slower_waves(scene))
      complain("speed", scene.speed, "with inertia must be below that of the waves which the layers carry together");
  }
  return broken;
}

}  // namespace rollres
