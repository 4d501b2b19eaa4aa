#include "core/scene.hpp"

#include <cmath>
#include <sstream>
#include <type_traits>

namespace rollres {

std::vector<std::string_view> input_keys() {
  std::vector<std::string_view> keys;
  const RollingScene scene;
  visit_inputs(scene, [&](const Quantity& quantity, const auto&) { keys.push_back(quantity.key); });
  return keys;
}

bool spectral_applies(const RollingScene& scene) {
  return scene.indenter == Indenter::cylinder && !scene.period && scene.poisson_ratio == 0.5;
}

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

  visit_inputs(scene, [&](const Quantity& quantity, const auto& value) {
    using Value = std::decay_t<decltype(value)>;
    if constexpr (std::is_arithmetic_v<Value>) {
      if (!quantity.range.contains(value)) complain(quantity.key, value, quantity.range.rule());
    } else if constexpr (std::is_same_v<Value, std::optional<double>>) {
      if (value && !quantity.range.contains(*value)) complain(quantity.key, *value, quantity.range.rule());
    } else if constexpr (std::is_same_v<Value, std::vector<double>>) {
      for (std::size_t i = 0; i < value.size(); ++i)
        if (!quantity.range.contains(value[i]))
          complain(std::string(quantity.key) + "[" + std::to_string(i) + "]", value[i], quantity.range.rule());
    }
  });
  for (std::string& line : check_material(scene)) broken.push_back(std::move(line));

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
  if (scene.approach && std::isinf(scene.layer_thickness) && scene.indenter == Indenter::cylinder)
    complain("approach", *scene.approach, "has no meaning for a cylinder on a half-space; give load");
  if (scene.method == Method::spectral) {
    if (scene.indenter == Indenter::sphere) complain("method", name_of(scene.method), "only for a cylinder");
    if (scene.period) complain("period", *scene.period, "not with method \"spectral\"");
    if (scene.poisson_ratio != 0.5)
      complain("poisson_ratio", scene.poisson_ratio, "must be 0.5 with method \"spectral\"");
  }
  if (scene.period && std::isinf(scene.layer_thickness))
    complain("period", *scene.period, "needs a layer of finite thickness");
  return broken;
}

}  // namespace rollres
