#include "core/model/scene_rules.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <type_traits>

#include "core/material/material_scale.hpp"
#include "core/material/prony_series.hpp"
#include "core/material/strain_softening.hpp"
#include "core/messages/message_text.hpp"
#include "core/model/contact_surface.hpp"
#include "core/model/heat_rules.hpp"
#include "core/model/motion_rules.hpp"
#include "core/scene/scene_input.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

namespace {

/// The first rule of method finite_strain that a coated cylinder breaks, as a line "key = value: rule"; empty if none:
/// it rolls on what must hardly yield.
std::string broken_for_cover(const ContactModel& model) {
  constexpr double rigid = 1000;
  double stiffest = 0;
  for (const ModelLayer& layer : model.coating)
    stiffest = std::max(stiffest, relaxation_spectrum(layer.creep).instantaneous);
  if (!(model.flow >= 0))
    return message_text("rotation_ratio = ", model.flow, ": must be >= 0 with method \"finite_strain\" and a coating");
  for (std::size_t i = 0; i < model.foundation.size(); ++i)
    if (const double modulus = model.foundation[i].modulus_at_rest; modulus < rigid * stiffest)
      return message_text(i == 0 ? "" : message_text("lower_layers[", i - 1, "]."), "static_shear_modulus = ", modulus,
                          ": with method \"finite_strain\" and a coating the layers under the body are taken as rigid "
                          "and must have at least ",
                          rigid, " times the coating's modulus, ", stiffest, " Pa");
  return {};
}

/// The same for any cylinder.
std::string broken_for_finite_strain(const ContactModel& model) {
  if (model.dimension == 3) return "method = finite_strain: only for a cylinder";
  if (!model.coating.empty()) {
    if (std::string rule = broken_for_cover(model); !rule.empty()) return rule;
  } else if (!has_rigid_base(model))
    return message_text(model.foundation.size() == 1 ? "layer_thickness" : "lower_layers",
                        " = \"infinite\": must be finite with method \"finite_strain\"");
  if (model.period) return message_text("period = ", *model.period, ": not with method \"finite_strain\"");
  if (model.adhesion_threshold > 0)
    return message_text("adhesion_threshold = ", model.adhesion_threshold, ": must be 0 with method \"finite_strain\"");
  if (model.inertia && !model.inertia_automatic) return "inertia = on: not with method \"finite_strain\"";
  if (model.inertia)
    return message_text("method = finite_strain: inertia counts for a tolerance of ", *model.asked_tolerance, " (V is ",
                        std::sqrt(rayleigh_number(model)),
                        " of the speed of Rayleigh waves on the layer at rest), and this method has none; "
                        "inertia = off leaves it out");
  return {};
}

/// The first input of a layer by which its moduli depend on the strain, with its value; empty if none.
std::string softening_key(const std::string& owner, const MaterialInputs& layer) {
  if (layer.payne_drop > 0) return message_text(owner, "payne_drop = ", layer.payne_drop);
  if (layer.payne_loss_peak != 1) return message_text(owner, "payne_loss_peak = ", layer.payne_loss_peak);
  if (!layer.sweep_strains.empty()) return owner + "sweep_strains";
  return {};
}

/// Lines "key = value: rule" and "key is missing: rule".
struct BrokenRules {
  std::vector<std::string> lines = {};

  void add(std::string_view key, const auto& value, const std::string& rule) {
    std::ostringstream line;
    line << key << " = " << value << ": " << rule;
    lines.push_back(line.str());
  }
  void add_missing(std::string_view key, const std::string& rule) {
    lines.push_back(std::string(key) + " is missing: " + rule);
  }
};

/// Sizes beyond which no contact of bodies is described, by the unit of a quantity other than 0.
std::optional<Range> plausible(std::string_view unit) {
  struct Size {
    std::string_view unit;
    Range range;
  };
  constexpr std::array<Size, 8> sizes{{{"m", {.lowest = 1e-11, .highest = 1e7}},
                                       {"m/s", {.lowest = 1e-20, .highest = 1e9}},
                                       {"Pa", {.lowest = 1e-12, .highest = 1e18}},
                                       {"s", {.lowest = 1e-40, .highest = 1e40}},
                                       {"K", {.lowest = 1e-9, .highest = 1e5}},
                                       {"kg/m3", {.lowest = 1e-12, .highest = 1e9}},
                                       {"N", {.lowest = 1e-25, .highest = 1e20}},
                                       {"1", {.lowest = 0, .highest = 1e15}}}};
  for (const Size& size : sizes)
    if (size.unit == unit) return size.range;
  return std::nullopt;
}

/// @param owner  what stands before the keys of a further layer: "coating_layers[0]."
template <class Value>
void check_range(const std::string& owner, const Quantity& quantity, const Value& value, BrokenRules& broken) {
  const auto key = [&] { return owner + std::string(quantity.key); };
  const auto check_number = [&](const auto& number, const std::string& place) {
    if (!quantity.range.contains(number)) return broken.add(key() + place, number, quantity.rule());
    const double size = std::abs(static_cast<double>(number));
    const std::optional<Range> sizes = plausible(quantity.unit);
    if (sizes && size != 0 && std::isfinite(size) && !sizes->contains(size))
      broken.add(key() + place, number, "size " + sizes->rule() + " " + std::string(quantity.unit));
  };
  if constexpr (std::is_arithmetic_v<Value>) {
    check_number(value, "");
  } else if constexpr (std::is_same_v<Value, std::optional<double>>) {
    if (value) check_number(*value, "");
  } else if constexpr (std::is_same_v<Value, std::vector<double>>) {
    for (std::size_t i = 0; i < value.size(); ++i) check_number(value[i], message_text("[", i, "]"));
  }
}

/// @param owner  as above
void check_shift(const std::string& owner, const MaterialInputs& layer, BrokenRules& broken) {
  constexpr Range sensible{.lowest = 1e-30, .highest = 1e30};
  if (const double shift = time_shift(layer); !sensible.contains(shift))
    broken.add(owner + "temperature", *layer.temperature,
               message_text("multiplies all times by ", shift, ", which ", sensible.rule()));
}

void check_shifts(const RollingScene& scene, BrokenRules& broken) {
  check_shift("", scene, broken);
  for (std::size_t i = 0; i < scene.lower_layers.size(); ++i)
    check_shift(message_text("lower_layers[", i, "]."), scene.lower_layers[i], broken);
  for (std::size_t i = 0; i < scene.coating_layers.size(); ++i)
    check_shift(message_text("coating_layers[", i, "]."), scene.coating_layers[i], broken);
}

void check_further_layers(const std::string& list, const BondedLayers& layers, BrokenRules& broken) {
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const std::string owner = list + "[" + std::to_string(i) + "].";
    visit_layer_inputs(
        layers[i], [&](const Quantity& quantity, const auto& value) { check_range(owner, quantity, value, broken); });
    for (const std::string& line : check_material(layers[i])) broken.lines.push_back(owner + line);
  }
}

void check_thicknesses(const RollingScene& scene, BrokenRules& broken) {
  double above = scene.layer_thickness;
  for (const BondedLayer& layer : scene.lower_layers) {
    if (std::isinf(above))
      broken.add("layer_thickness", "\"infinite\"", "only the last of the lower layers may be infinite");
    above = layer.layer_thickness;
  }
  double coating = 0;
  for (const BondedLayer& layer : scene.coating_layers) coating += layer.layer_thickness;
  const bool several = scene.coating_layers.size() > 1;
  if (!scene.coating_layers.empty() && coating >= scene.radius)
    broken.lines.push_back(
        message_text<6>(several ? "coating_layers: layer_thickness = " : "coating_layers[0].layer_thickness = ",
                        std::isinf(coating) ? "\"infinite\"" : message_text<6>(coating), several ? " together" : "",
                        ": must be less than the radius, ", scene.radius, " m"));
}

void check_alternatives(const RollingScene& scene, BrokenRules& broken) {
  if (scene.load && scene.approach) broken.add("approach", *scene.approach, "give load or approach, not both");
  if (!scene.load && !scene.approach) broken.add_missing("load", "give load or approach");
  if (scene.width && dimension_of(scene.indenter) == 3)
    broken.add("width", *scene.width,
               "only for a cylinder: loads and forces of other bodies are those of the whole body");
  if (scene.spacing && scene.tolerance)
    broken.add("tolerance", *scene.tolerance, "give spacing or tolerance, not both");
}

/// Methods whose friction is of nodal forces have no bound in pascal.
void check_traction_limit(const RollingScene& scene, BrokenRules& broken) {
  if (!scene.traction_limit || scene.friction_coefficient == 0) return;
  if (scene.method == Method::active_set || scene.method == Method::finite_strain)
    broken.add("traction_limit", *scene.traction_limit,
               message_text("not with method \"", name_of(scene.method), "\" and friction"));
}

void check_against_radius(const RollingScene& scene, BrokenRules& broken) {
  if (scene.indenter == Indenter::pressure) return;
  if (scene.spacing && *scene.spacing > 0.2 * scene.radius)
    broken.add("spacing", *scene.spacing, "must be at most a fifth of the radius");
  if (scene.approach && *scene.approach >= scene.radius)
    broken.add("approach", *scene.approach, "must be less than the radius");
}

void check_drive(const RollingScene& scene, BrokenRules& broken) {
  const bool torque = scene.drive == Drive::torque, rotation = scene.drive == Drive::rotation;
  if (torque && !scene.driving_torque) broken.add_missing("driving_torque", "drive \"torque\" needs it");
  if (!torque && scene.driving_torque)
    broken.add("driving_torque", *scene.driving_torque, "only with drive \"torque\"");
  if (torque && scene.friction_coefficient == 0 && scene.driving_torque.value_or(0) != 0)
    broken.add("driving_torque", *scene.driving_torque,
               "needs a friction_coefficient > 0: without friction nothing holds the body against it");
  if (rotation && !scene.rotation_ratio) broken.add_missing("rotation_ratio", "drive \"rotation\" needs it");
  if (!rotation && scene.rotation_ratio)
    broken.add("rotation_ratio", *scene.rotation_ratio, "only with drive \"rotation\"");
}

/// Only finite strains feel Yeoh's terms.
void check_yeoh(const RollingScene& scene, BrokenRules& broken) {
  if (scene.method == Method::finite_strain) return;
  const auto check_layer = [&](const std::string& owner, const MaterialInputs& layer) {
    constexpr const char* rule =
        "only with method \"finite_strain\": the others take strains as small, where it has no effect";
    if (layer.yeoh_second != 0) return broken.add(owner + "yeoh_second", layer.yeoh_second, rule);
    if (layer.yeoh_third != 0) broken.add(owner + "yeoh_third", layer.yeoh_third, rule);
  };
  check_layer("", scene);
  for (std::size_t i = 0; i < scene.lower_layers.size(); ++i)
    check_layer(message_text("lower_layers[", i, "]."), scene.lower_layers[i]);
  for (std::size_t i = 0; i < scene.coating_layers.size(); ++i)
    check_layer(message_text("coating_layers[", i, "]."), scene.coating_layers[i]);
}

void check_interior(const RollingScene& scene, BrokenRules& broken) {
  const std::string why = why_no_interior(scene);
  if (why.empty()) return;
  std::vector<std::string> asking{softening_key("", scene)};
  if (scene.interior == Interior::on) asking.push_back("interior = on");
  const auto add_layers = [&](const char* list, const BondedLayers& layers) {
    for (std::size_t i = 0; i < layers.size(); ++i)
      asking.push_back(softening_key(message_text(list, "[", i, "]."), layers[i]));
  };
  add_layers("lower_layers", scene.lower_layers);
  add_layers("coating_layers", scene.coating_layers);
  for (const std::string& key : asking) {
    if (key.empty()) continue;
    broken.lines.push_back(key + ": " + why);
  }
}

void check_inertia(const ContactModel& model, BrokenRules& broken) {
  if (const double number = rayleigh_number(model); number >= 1)
    broken.add("speed", model.speed,
               "with inertia must be below that of Rayleigh waves on the layer at rest, " +
                   message_text(model.speed / std::sqrt(number)) + " m/s");
  else if (layers_carry_slower_waves(model))
    broken.add("speed", model.speed, "with inertia must be below that of the waves which the layers carry together");
}

/// @param in_range  whether every input is in its range, so that there is a model of it
void check_model(const RollingScene& scene, bool in_range, BrokenRules& broken) {
  if (const std::string why = why_absent(scene, "approach"); scene.approach && !why.empty())
    broken.add("approach", *scene.approach, why + ", or a load");
  if (scene.method == Method::convolution && scene.indenter != Indenter::pressure)
    broken.lines.push_back("method = convolution: only with indenter \"pressure\"");
  const bool spectral = scene.method == Method::spectral, finite = scene.method == Method::finite_strain;
  const bool asked = in_range && (spectral || finite || scene.inertia == Inertia::on);
  const std::optional<ContactModel> model = asked ? std::optional<ContactModel>(scene) : std::nullopt;
  if (model && (spectral || finite))
    if (std::string rule = spectral ? spectral_refusal(*model) : broken_for_finite_strain(*model); !rule.empty())
      broken.lines.push_back(std::move(rule));
  check_interior(scene, broken);
  check_yeoh(scene, broken);
  if (scene.period && on_half_space(scene)) broken.add("period", *scene.period, "needs a layer of finite thickness");
  if (model && scene.inertia == Inertia::on) check_inertia(*model, broken);
}

/// Of a temperature that the uppermost layer has no use for: whose was meant. Empty if no other layer has a law of
/// shift.
std::string other_temperature(const RollingScene& scene) {
  for (const auto& [list, layers] :
       {std::pair("coating_layers[", &scene.coating_layers), std::pair("lower_layers[", &scene.lower_layers)})
    for (std::size_t i = 0; i < layers->size(); ++i) {
      if (!has_shift((*layers)[i])) continue;
      const std::string layer = message_text(list, i, "]");
      return "; " + layer + " has one: " +
             (scene.heat == Heat::on ? "heat = on finds its temperature from ambient_temperature"
                                     : "its temperature is " + layer + ".temperature");
    }
  return {};
}

}  // namespace

bool on_half_space(const RollingScene& scene) {
  return std::isinf(scene.layer_thickness) ||
         std::any_of(scene.lower_layers.begin(), scene.lower_layers.end(),
                     [](const BondedLayer& layer) { return std::isinf(layer.layer_thickness); });
}

std::string why_no_interior(const RollingScene& scene) {
  if (scene.period) return "not with a period";
  if (scene.method == Method::finite_strain) return "not with method \"finite_strain\"";
  return {};
}

std::string spectral_refusal(const ContactModel& model) {
  if (model.dimension == 3) return "method = spectral: only for a cylinder";
  if (model.period) return message_text("period = ", *model.period, ": not with method \"spectral\"");
  if (model.lateral()) return "skew_angle: not with method \"spectral\" and friction";
  if (model.traction_limit && model.friction_coefficient > 0)
    return message_text("traction_limit = ", *model.traction_limit, ": not with method \"spectral\" and friction");
  if (model.coating.empty()) return {};
  if (model.inertia) return "inertia: not with method \"spectral\" and a coating";
  if (coating_remembers_ahead(model))
    return message_text("rotation_ratio = ", model.flow,
                        ": must be >= 0 with method \"spectral\" and a viscoelastic coating");
  // Two half-spaces whose pressure moves the surface sideways do so with memories of their own.
  const bool on_body = model.coating.front().poisson_ratio < 0.5;
  if (!on_body && !(model.top().poisson_ratio < 0.5)) return {};
  return message_text(on_body ? "coating_layers[0].poisson_ratio = " : "poisson_ratio = ",
                      (on_body ? model.coating.front() : model.top()).poisson_ratio,
                      ": must be 0.5 with method \"spectral\" and a coating");
}

Method resolved_method(const RollingScene& scene) {
  if (scene.method != Method::automatic) return scene.method;
  if (scene.indenter == Indenter::pressure) return Method::convolution;
  const bool gridded = dimension_of(scene.indenter) == 3 || scene.spacing || scene.period;
  return gridded ? Method::newton : ContactModel(scene).method;
}

std::vector<std::string> check(const RollingScene& scene) {
  BrokenRules broken;
  const std::string no_owner;
  visit_inputs(scene,
               [&](const Quantity& quantity, const auto& value) { check_range(no_owner, quantity, value, broken); });
  for (std::string& line : check_material(scene))
    broken.lines.push_back(line + (scene.temperature && !has_shift(scene) && line.starts_with("temperature = ")
                                       ? other_temperature(scene)
                                       : ""));
  check_further_layers("lower_layers", scene.lower_layers, broken);
  check_further_layers("coating_layers", scene.coating_layers, broken);
  if (broken.lines.empty()) check_shifts(scene, broken);
  const bool in_range = broken.lines.empty();
  check_thicknesses(scene, broken);
  check_alternatives(scene, broken);
  check_against_radius(scene, broken);
  check_drive(scene, broken);
  for (std::string& line : broken_motion_rules(scene)) broken.lines.push_back(std::move(line));
  check_traction_limit(scene, broken);
  for (std::string& line : broken_heat_rules(scene, in_range)) broken.lines.push_back(std::move(line));
  check_model(scene, broken.lines.empty() || (in_range && scene.heat == Heat::off), broken);
  return broken.lines;
}

void require_valid(const RollingScene& scene) {
  if (const std::vector<std::string> broken = check(scene); !broken.empty())
    throw std::invalid_argument(joined(broken, "; "));
}

SolutionLimits limits_of(const RollingScene& scene) {
  return SolutionLimits(scene.memory_limit.value_or(usual_memory_limit()), scene.time_limit.value_or(usual_time_limit));
}

}  // namespace rollres
