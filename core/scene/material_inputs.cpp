#include "core/scene/material_inputs.hpp"

#include <algorithm>
#include <sstream>
#include <type_traits>

namespace rollres {

namespace {

using Lines = std::vector<std::string>;

std::string missing(std::string_view key, const std::string& rule) { return std::string(key) + " is missing: " + rule; }

std::string broken(std::string_view key, double value, const std::string& rule) {
  std::ostringstream line;
  line << key << " = " << value << ": " << rule;
  return line.str();
}

/// Lists that belong together, the first of which says how many values the others have.
void check_lists(const MaterialInputs& layer, Lines& lines) {
  std::string_view first;
  std::size_t count = 0;
  const std::vector<std::string_view> needed = needed_inputs(layer.material);
  visit_material_inputs(layer, [&](const Quantity& quantity, const auto& value) {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::vector<double>>) {
      if (find_name(needed, quantity.key) < 0) return;
      if (value.empty()) {
        lines.push_back(missing(quantity.key, "material \"" + std::string(name_of(layer.material)) + "\" needs it"));
      } else if (first.empty()) {
        first = quantity.key;
        count = value.size();
      } else if (value.size() != count) {
        lines.push_back(std::string(quantity.key) + ": has " + std::to_string(value.size()) + " values, but " +
                        std::string(first) + " has " + std::to_string(count));
      }
    }
  });
}

void check_frequencies(const MaterialInputs& layer, Lines& lines) {
  constexpr Range measurable{.lowest = 1e-30, .highest = 1e30};  // [Hz], also of shifted rows
  const auto& all = layer.frequencies;
  for (std::size_t i = 0; layer.material == MaterialModel::master_curve && i < all.size(); ++i)
    if (!measurable.contains(all[i]) && all[i] > 0)
      lines.push_back(broken("frequencies[" + std::to_string(i) + "]", all[i], measurable.rule() + " Hz"));
  if (layer.material == MaterialModel::master_curve && !all.empty() &&
      std::all_of(all.begin(), all.end(), [&](double frequency) { return frequency == all.front(); }))
    lines.push_back("frequencies: must have at least two different values");
}

void check_modulus(const MaterialInputs& layer, Lines& lines) {
  const bool shear = layer.static_shear_modulus.has_value(), young = layer.static_young_modulus.has_value();
  if (shear != young || (!shear && !needs_static_modulus(layer.material))) return;
  const std::string rule = "give static_shear_modulus or static_young_modulus";
  if (shear)
    lines.push_back(broken("static_young_modulus", *layer.static_young_modulus, rule + ", not both"));
  else
    lines.push_back(missing("static_shear_modulus", rule + " (Pa)"));
}

void check_temperature(const MaterialInputs& layer, Lines& lines) {
  const bool wlf = layer.wlf_c1 || layer.wlf_c2, arrhenius = layer.activation_energy.has_value();
  constexpr const char* both = "wlf_c1 and wlf_c2 go together";
  if (layer.wlf_c1 && !layer.wlf_c2) lines.push_back(missing("wlf_c2", both));
  if (layer.wlf_c2 && !layer.wlf_c1) lines.push_back(missing("wlf_c1", both));
  if (wlf && arrhenius)
    lines.push_back(
        broken("activation_energy", *layer.activation_energy, "give wlf_c1 and wlf_c2 or activation_energy, not both"));
  if (!layer.temperature) return;
  if (!wlf && !arrhenius)
    lines.push_back(broken("temperature", *layer.temperature,
                           "has no effect without a shift law: give wlf_c1 and wlf_c2, or activation_energy"));
  else if (!layer.reference_temperature)
    lines.push_back(missing("reference_temperature", "a temperature needs it (K)"));
  else if (layer.wlf_c2 && *layer.temperature <= *layer.reference_temperature - *layer.wlf_c2)
    lines.push_back(broken("temperature", *layer.temperature, "must be above reference_temperature - wlf_c2"));
}

void check_softening(const MaterialInputs& layer, Lines& lines) {
  const bool kraus = layer.payne_drop > 0 || layer.payne_loss_peak != 1;
  const std::string_view first = layer.payne_drop > 0 ? "payne_drop" : "payne_loss_peak";
  const double value = layer.payne_drop > 0 ? layer.payne_drop : layer.payne_loss_peak;
  if (kraus && !layer.payne_strain) lines.push_back(missing("payne_strain", std::string(first) + " needs it"));
  if (kraus && !layer.sweep_strains.empty())
    lines.push_back(broken(first, value, "give Kraus's model or a strain sweep, not both"));
  const std::size_t rows = layer.sweep_strains.size();
  const auto check_list = [&](std::string_view key, std::size_t count) {
    if (count != rows)
      lines.push_back(std::string(key) + ": has " + std::to_string(count) + " values, but sweep_strains has " +
                      std::to_string(rows));
  };
  check_list("sweep_storage_moduli", layer.sweep_storage_moduli.size());
  check_list("sweep_loss_moduli", layer.sweep_loss_moduli.size());
  if (rows == 1) lines.push_back("sweep_strains: must have at least two values");
  for (std::size_t i = 1; i < rows; ++i)
    if (!(layer.sweep_strains[i] > layer.sweep_strains[i - 1]))
      lines.push_back(broken("sweep_strains[" + std::to_string(i) + "]", layer.sweep_strains[i],
                             "must be above the one before: a sweep is listed from small strains to large"));
}

}  // namespace

std::vector<std::string_view> needed_inputs(MaterialModel material) {
  switch (material) {
    case MaterialModel::elastic:
      return {};
    case MaterialModel::zener:
      return {"stiffening", "creep_time"};
    case MaterialModel::fractional_zener:
      return {"stiffening", "creep_time", "fractional_order"};
    case MaterialModel::prony:
      return {"relaxation_times", "relaxation_moduli"};
    case MaterialModel::master_curve:
      return {"frequencies", "storage_moduli", "loss_moduli"};
  }
  return {};
}

std::vector<std::string> check_material(const MaterialInputs& layer) {
  Lines lines;
  check_modulus(layer, lines);
  check_lists(layer, lines);
  check_frequencies(layer, lines);
  check_temperature(layer, lines);
  check_softening(layer, lines);
  return lines;
}

}  // namespace rollres
