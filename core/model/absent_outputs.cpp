#include "core/model/absent_outputs.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "core/material/strain_softening.hpp"
#include "core/model/scene_rules.hpp"
#include "core/scene/scene_input.hpp"
#include "core/scene/solution.hpp"
#include "core/scene/warmed_layers.hpp"

namespace rollres {

namespace {

/// Of what a given pressure alone has, or has not.
std::string why_absent_under_pressure(Indenter indenter, std::string_view output) {
  constexpr std::array<std::string_view, 5> deflections{"deflection", "peak_deflection", "peak_deflection_x",
                                                        "deflections", "deflection_error"};
  constexpr std::string_view of_body =
      "approach driving_force driving_torque rotation_speed rotation_ratio frictional_loss law_violation "
      "friction_needed friction_borne";
  if (indenter != Indenter::pressure)
    return find_name(deflections, output) >= 0 ? "indenter \"pressure\" has it" : std::string();
  return has_word(of_body, output) ? "a given pressure has none" : std::string();
}

std::string why_absent(bool sphere, bool half_space, std::string_view output) {
  if (sphere) return {};
  if (output == "approach" && half_space)
    return "a cylinder sinks without limit into a half-space, with the logarithm of the depth from which the approach "
           "is counted: give that depth as layer_thickness";
  constexpr std::array<std::string_view, 4> across{"half_width", "peak_shear_y", "peak_pressure_x", "peak_pressure_y"};
  if (find_name(across, output) >= 0) return "a cylinder has none";
  return {};
}

}  // namespace

std::string why_absent(const RollingScene& scene, std::string_view output) {
  if (const std::optional<ElementKey> element = element_key(output); element && output_quantity(output)) {
    const std::size_t layers = 1 + scene.lower_layers.size() + scene.coating_layers.size();
    if (element->place >= layers)
      return "the scene has " + std::to_string(layers) +
             (layers == 1 ? " layer: [0]" : " layers: [0] to [" + std::to_string(layers - 1) + "]");
    output = element->list;
  }
  constexpr std::string_view of_inside =
      "peak_shear_strain peak_shear_strain_x peak_shear_strain_y peak_shear_strain_z strain_amplitude "
      "peak_strain_amplitude bond_shear bond_tension bond_shears bond_tensions interior_loss";
  const bool softening = softens(scene) || std::any_of(scene.lower_layers.begin(), scene.lower_layers.end(), softens) ||
                         std::any_of(scene.coating_layers.begin(), scene.coating_layers.end(), softens);
  constexpr std::string_view of_heat =
      "mean_temperature peak_temperature peak_temperature_depth bond_temperature surface_temperature heat_to_air "
      "heat_to_ground heat_to_core warming_time peclet fourier biot temperatures sublayer_temperatures";
  if (has_word(of_heat, output) && scene.heat == Heat::off) return "heat = on computes it";
  if (output == "sublayer_temperatures" && scene.thermal_sublayers == 1) return "thermal_sublayers = 1";
  if (output == "sublayer_temperatures" && !depends_on_temperature(scene))
    return "no material that heat warms has a law of shift";
  constexpr std::array<std::string_view, 3> of_capacity{"warming_time", "peclet", "fourier"};
  if (find_name(of_capacity, output) >= 0 && !scene.heat_capacity) return "heat_capacity is not given";
  if (output == "softening" && !softening) return "no layer's moduli depend on the strain";
  const bool amplitude = output == "strain_amplitude" || output == "peak_strain_amplitude";
  if (scene.interior == Interior::off && !(amplitude && softening) && has_word(of_inside, output))
    return "interior = on computes it";
  if (std::string why = why_absent_under_pressure(scene.indenter, output); !why.empty()) return why;
  if (output == "deflections" && scene.deflection_places_x.empty()) return "deflection_places_x is not given";
  return why_absent(dimension_of(scene.indenter) == 3, on_half_space(scene), output);
}

std::string why_absent(const ContactModel& model, std::string_view output) {
  if (std::string why = why_absent_under_pressure(model.indenter, output); !why.empty()) return why;
  return why_absent(model.dimension == 3, model.half_space, output);
}

}  // namespace rollres
