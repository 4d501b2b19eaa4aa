#include "studies/fit/fitted_scene.hpp"

#include <array>

#include "fitting/fit/measured_terms.hpp"
#include "studies/scene_io/doubtful_number.hpp"
#include "studies/scene_io/scene_inputs.hpp"
#include "studies/scene_io/solution_json.hpp"
#include "studies/text/files.hpp"
#include "studies/text/strict_json.hpp"
#include "studies/text/table_json.hpp"

namespace rollres {

namespace {

bool shifts(const TemperatureShift& shift) { return shift.law != ShiftLaw::none || !shift.table.temperatures.empty(); }

/// Numbers that a scene refuses without a unit get it.
void add_units(Json& inputs) {
  for (auto& [key, value] : inputs.items()) {
    const InputKind* const kind = find_input(key);
    if (!kind || kind->layers) continue;
    if (value.is_number()) value = written_input(kind->quantity, value.get<double>());
    const auto is_number = [](const Json& one) { return one.is_number(); };
    if (value.is_array() && all_of(value, is_number))
      value = written_input(kind->quantity, value.get<std::vector<double>>());
  }
}

void add_shift(Json& inputs, const TemperatureShift& shift) {
  if (shifts(shift)) inputs["reference_temperature"] = shift.reference;
  if (shift.law == ShiftLaw::wlf) {
    inputs["wlf_c1"] = shift.c1;
    inputs["wlf_c2"] = shift.c2;
  } else if (shift.law == ShiftLaw::arrhenius) {
    inputs["activation_energy"] = shift.activation_energy;
  } else if (shift.law == ShiftLaw::vft) {
    inputs["vft_b"] = shift.vft_b;
    inputs["vft_temperature"] = shift.vft_temperature;
  }
  for (const auto& [key, list] :
       {std::pair("shift_temperatures", &shift.table.temperatures), std::pair("shift_factors", &shift.table.factors),
        std::pair("modulus_shifts", &shift.table.moduli)})
    if (!list->empty()) inputs[key] = *list;
  add_units(inputs);
}

Json material_inputs(const MaterialFit& fit, MaterialForm form) {
  Json inputs{{"material", name_of(form)}};
  if (form == MaterialForm::prony) {
    if (fit.prony.static_modulus > 0) inputs["static_shear_modulus"] = fit.prony.static_modulus;
    for (const PronySeries::Term& term : ordered(fit.prony).terms) {
      inputs["relaxation_times"].push_back(term.time);
      inputs["relaxation_moduli"].push_back(term.modulus);
    }
    inputs["listed_moduli"] = "shear";
  } else {
    inputs["static_shear_modulus"] = fit.zener.static_modulus;
    inputs["stiffening"] = fit.zener.stiffening;
    inputs["creep_time"] = fit.zener.creep_time;
    if (form == MaterialForm::fractional_zener) inputs["fractional_order"] = fit.zener.order;
  }
  add_shift(inputs, fit.shift);
  return inputs;
}

/// Inputs of a law of shift, or of the a_T in its place.
bool is_law(std::string_view key) {
  constexpr std::array<std::string_view, 7> keys{
      "reference_temperature", "wlf_c1", "wlf_c2", "activation_energy", "vft_b", "vft_temperature", "shift_factors"};
  return find_name(keys, key) >= 0;
}

bool is_shift(std::string_view key) { return is_law(key) || key == "shift_temperatures" || key == "modulus_shifts"; }

/// Inputs of a material that a fitted one replaces. Its temperature stays, and its shift where none was fitted.
bool is_replaced(std::string_view key, bool shifted) {
  if (key == "poisson_ratio" || key == "temperature") return false;
  if (is_shift(key)) return shifted;
  bool found = false;
  MaterialInputs any;
  visit_material_inputs(any, [&](const Quantity& quantity, const auto&) { found |= quantity.key == key; });
  return found;
}

/// The inputs of a fit file's scene that are not replaced. @param replaced  whether one is, of the scene and its key
template <class Replaced>
Json kept_inputs(const std::string& scene, const Replaced& replaced) {
  const Json given = scene.empty() ? Json::object() : Json::parse(scene);
  Json kept = Json::object();
  for (const auto& [key, value] : given.items())
    if (!replaced(given, key)) kept[key] = value;
  return kept;
}

}  // namespace

std::string fitted_scene(const MaterialFit& fit, const MaterialFile& file) {
  Json scene =
      kept_inputs(file.scene, [&](const Json&, const std::string& key) { return is_replaced(key, shifts(fit.shift)); });
  scene.update(material_inputs(fit, file.options.form));
  return text_of(scene, 2);
}

std::string fitted_scene(const ShiftFit& fit, const ShiftFile& file) {
  Json scene = kept_inputs(file.scene, [](const Json& given, const std::string& key) {
    return given.contains("modulus_shifts") ? is_law(key) : is_shift(key);  // its b_T stay
  });
  add_shift(scene, fit.shift);
  return text_of(scene, 2);
}

std::string fitted_scene(const StrainFit& fit, const StrainFile& file) {
  Json scene = kept_inputs(file.scene, [](const Json&, const std::string& key) { return key.starts_with("sweep_"); });
  scene["payne_drop"] = fit.layer.payne_drop;
  scene["payne_strain"] = fit.layer.payne_strain.value();
  scene["payne_exponent"] = fit.layer.payne_exponent;
  scene["payne_loss_peak"] = fit.layer.payne_loss_peak;
  return text_of(scene, 2);
}

std::string fitted_scene(const FitReport& report, const FitFile& file) {
  RollingScene scene = file.scenes.front().scene;
  for (std::size_t j = 0; j < file.inputs.size(); ++j)
    if (!is_measured_term(file.inputs[j].input.key) &&
        (file.inputs[j].set.empty() || file.inputs[j].set == file.scenes.front().set))
      set_input(scene, file.inputs[j].input.key, report.parameters[j].value);
  return scene_json(scene);
}

void write_scene(const std::filesystem::path& file, const std::string& scene) {
  if (const auto folder = file.parent_path(); !folder.empty()) make_directory(folder);
  write_file(file, scene.ends_with('\n') ? scene : scene + '\n');
}

}  // namespace rollres
