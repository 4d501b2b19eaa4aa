#include "core/scene/idle_inputs.hpp"

#include "core/scene/scene_input.hpp"

namespace rollres {

namespace {

/// Inputs of which a material model takes the ones that needed_inputs lists.
constexpr std::array<std::string_view, 8> of_models{"stiffening",       "creep_time",        "fractional_order",
                                                    "relaxation_times", "relaxation_moduli", "frequencies",
                                                    "storage_moduli",   "loss_moduli"};

/// Inputs that only the heat of rolling asks for.
constexpr std::array<std::string_view, 11> of_heat{
    "thermal_conductivity", "heat_capacity",      "turn_length",        "surface_heat_transfer",
    "ambient_temperature",  "ground_effusivity",  "ground_temperature", "core",
    "core_temperature",     "core_heat_transfer", "thermal_sublayers"};

bool is_idle(const MaterialInputs& layer, std::string_view key) {
  if (find_name(of_models, key) >= 0) return find_name(needed_inputs(layer.material), key) < 0;
  if (key == "listed_moduli") return layer.material != MaterialModel::prony && !is_measured_curve(layer.material);
  if (key.starts_with("payne_")) return layer.payne_drop == 0 && layer.payne_loss_peak == 1;
  if (key.starts_with("sweep_")) return layer.sweep_strains.empty();
  if (key.starts_with("yeoh_")) return layer.yeoh_second == 0 && layer.yeoh_third == 0;
  return false;
}

}  // namespace

bool is_idle(const RollingScene& scene, std::string_view key) {
  if (const std::optional<LayerKey> layered = layer_key(key)) {
    const auto& layers = layered->list == "coating_layers" ? scene.coating_layers : scene.lower_layers;
    return layered->layer < layers.size() && is_idle(layers[layered->layer], layered->input);
  }
  const bool sphere = dimension_of(scene.indenter) == 3, paper = scene.method == Method::active_set;
  if (key == "crown") return scene.indenter != Indenter::roller;
  if (key.starts_with("profile_")) return scene.indenter != Indenter::profile;
  if (key.starts_with("pressure_") || key.starts_with("deflection_") || key == "traction_coefficient")
    return scene.indenter != Indenter::pressure;
  if (find_name(of_heat, key) >= 0) return scene.heat == Heat::off;
  if (key == "series_terms") return !scene.period;
  if (key == "slip_stencil" || key == "slip_threshold") return !paper;
  if (key == "resticking") return !paper || sphere;
  if (key == "slip_rule") return !paper || !sphere;
  return is_idle(static_cast<const MaterialInputs&>(scene), key);
}

}  // namespace rollres
