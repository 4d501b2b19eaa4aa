#include "core/scene/material_inputs.hpp"

#include <algorithm>
#include <sstream>
#include <type_traits>

#include "core/scene/shift_reach.hpp"

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

void check_relaxation(const MaterialInputs& layer, Lines& lines) {
  if (layer.material != MaterialModel::relaxation_curve) return;
  const auto& times = layer.relaxation_times;
  if (!times.empty() && std::all_of(times.begin(), times.end(), [&](double time) { return time == times.front(); }))
    lines.push_back("relaxation_times: must have at least two different values");
  for (std::size_t i = 0; i < layer.relaxation_moduli.size(); ++i)
    if (layer.relaxation_moduli[i] == 0)
      lines.push_back(broken("relaxation_moduli[" + std::to_string(i) + "]", 0, "must be > 0 in a relaxation_curve"));
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

/// The laws of shift that are given, by the input that stands for each.
std::vector<std::string_view> shift_laws(const MaterialInputs& layer) {
  std::vector<std::string_view> laws;
  if (layer.wlf_c1 || layer.wlf_c2) laws.emplace_back("wlf_c1");
  if (layer.activation_energy) laws.emplace_back("activation_energy");
  if (layer.vft_b || layer.vft_temperature) laws.emplace_back("vft_b");
  if (!layer.shift_factors.empty()) laws.emplace_back("shift_factors");
  return laws;
}

constexpr const char* laws_in_words =
    "wlf_c1 and wlf_c2, activation_energy, vft_b and vft_temperature, or shift_factors";

void check_pair(std::string_view first, bool has_first, std::string_view second, bool has_second, Lines& lines) {
  if (has_first == has_second) return;
  lines.push_back(
      missing(has_first ? second : first, std::string(first) + " and " + std::string(second) + " go together"));
}

void check_shift_table(const MaterialInputs& layer, Lines& lines) {
  const auto& temperatures = layer.shift_temperatures;
  const std::size_t rows = temperatures.size();
  bool used = false;
  for (const auto& [key, list] :
       {std::pair("shift_factors", &layer.shift_factors), std::pair("modulus_shifts", &layer.modulus_shifts)}) {
    if (list->empty()) continue;
    used = true;
    if (rows == 0)
      lines.push_back(missing("shift_temperatures", std::string(key) + " needs it (K)"));
    else if (list->size() != rows)
      lines.push_back(std::string(key) + ": has " + std::to_string(list->size()) +
                      " values, but shift_temperatures has " + std::to_string(rows));
  }
  if (!used || rows == 0) return;
  if (rows == 1) lines.push_back("shift_temperatures: must have at least two values");
  std::vector<double> sorted = temperatures;
  std::sort(sorted.begin(), sorted.end());
  if (const auto twice = std::adjacent_find(sorted.begin(), sorted.end()); twice != sorted.end())
    lines.push_back(broken("shift_temperatures", *twice, "given twice"));
  const std::size_t last = rows - 1, second = std::min<std::size_t>(1, last), before_last = last - second;
  const auto [lowest, highest] = reach_of_shifts(sorted[0], sorted[second], sorted[before_last], sorted[last]);
  for (const auto& [key, value] :
       {std::pair("temperature", layer.temperature), std::pair("reference_temperature", layer.reference_temperature)}) {
    if (!layer.temperature || !value) continue;
    if (*value >= lowest && *value <= highest) continue;
    std::ostringstream rule;
    rule << "must be within shift_temperatures, " << sorted.front() << " to " << sorted.back()
         << " K: beyond its ends the table goes on by half a step and 1 K at most";
    lines.push_back(broken(key, *value, rule.str()));
  }
}

void check_temperature(const MaterialInputs& layer, Lines& lines) {
  check_pair("wlf_c1", layer.wlf_c1.has_value(), "wlf_c2", layer.wlf_c2.has_value(), lines);
  check_pair("vft_b", layer.vft_b.has_value(), "vft_temperature", layer.vft_temperature.has_value(), lines);
  check_shift_table(layer, lines);
  const std::string all = laws_in_words;
  if (const auto laws = shift_laws(layer); laws.size() > 1)
    lines.push_back(std::string(laws.front()) + " and " + std::string(laws.back()) + ": give one law of shift: " + all);
  if (!layer.temperature) return;
  if (!has_shift(layer))
    lines.push_back(broken("temperature", *layer.temperature, "has no effect without a shift law: give " + all));
  else if (!layer.reference_temperature)
    lines.push_back(missing("reference_temperature", "a temperature needs it (K)"));
  else if (layer.wlf_c2 && *layer.temperature <= *layer.reference_temperature - *layer.wlf_c2)
    lines.push_back(broken("temperature", *layer.temperature, "must be above reference_temperature - wlf_c2"));
  else if (layer.vft_temperature)
    for (const auto& [key, value] : {std::pair("temperature", *layer.temperature),
                                     std::pair("reference_temperature", *layer.reference_temperature)})
      if (value <= *layer.vft_temperature) lines.push_back(broken(key, value, "must be above vft_temperature"));
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

/// In shear g the stress of Yeoh's solid rises as 1 + 6 c_2 g^2 + 15 c_3 g^4.
void check_yeoh(const MaterialInputs& layer, Lines& lines) {
  const double second = layer.yeoh_second, least = 0.6 * second * second;
  if (second >= 0 || layer.yeoh_third > least) return;
  std::ostringstream rule;
  rule << "the stress would fall with the shear; yeoh_third = " << layer.yeoh_third
       << " must be above 0.6 yeoh_second^2 = " << least;
  lines.push_back(broken("yeoh_second", second, rule.str()));
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
    case MaterialModel::relaxation_curve:
      return {"relaxation_times", "relaxation_moduli"};
    case MaterialModel::master_curve:
      return {"frequencies", "storage_moduli", "loss_moduli"};
  }
  return {};
}

bool has_shift(const MaterialInputs& layer) { return !shift_laws(layer).empty() || !layer.modulus_shifts.empty(); }

std::vector<std::string> check_material(const MaterialInputs& layer) {
  Lines lines;
  check_modulus(layer, lines);
  check_lists(layer, lines);
  check_frequencies(layer, lines);
  check_relaxation(layer, lines);
  check_temperature(layer, lines);
  check_softening(layer, lines);
  check_yeoh(layer, lines);
  return lines;
}

}  // namespace rollres
