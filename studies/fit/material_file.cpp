#include "studies/fit/material_file.hpp"

#include <numbers>
#include <optional>
#include <stdexcept>

#include "db/file/digest.hpp"
#include "fitting/fit/resistance_fit.hpp"
#include "fitting/material/free_shifts.hpp"
#include "studies/fit/fit_keys.hpp"
#include "studies/scene_io/doubtful_number.hpp"
#include "studies/scene_io/master_curve_file.hpp"
#include "studies/scene_io/scene_entries.hpp"
#include "studies/study/study_scene.hpp"
#include "studies/text/file_kind.hpp"
#include "studies/text/strict_json.hpp"
#include "studies/text/units.hpp"

namespace rollres {

namespace {

constexpr double usual_reference_temperature = 293.15;  // [K]: 20 degC

SeriesTimes given_times(const Json& object, const MaterialFitOptions& options, const std::string& place) {
  const auto times = choice_or_first<SeriesTimes>(object, "times", place);
  if (times == SeriesTimes::free && (options.terms == 0 || options.terms > most_free_terms))
    refuse(place, "times", object.at("times"), "needs a number of terms from 1 to " + std::to_string(most_free_terms));
  return times;
}

}  // namespace

double relative_sigma(const Json& value, const std::string& key, const std::string& place, const char* rule) {
  if (value.is_string())
    if (const auto part = percentage(value.get_ref<const std::string&>()); part && *part > 0) return *part;
  refuse(place, key, value, rule);
}

ModulusSigmas given_modulus_sigmas(const Json& object, const std::string& place) {
  const auto found = object.find("sigma");
  if (found == object.end()) return {};
  if (!found->is_object()) {
    const double all = relative_sigma(*found, "sigma", place,
                                      "must be a percentage > 0 (\"2 %\"), or an object with one for storage_modulus "
                                      "and one for loss_modulus");
    return {true, all, all};
  }
  const std::string inside = place + ": sigma";
  refuse_unknown_keys(*found, modulus_sigma_keys, inside);
  const auto of = [&](const std::string& key) {
    constexpr const char* rule = "must be a percentage > 0: \"2 %\"";
    return relative_sigma(needed(*found, key, inside, rule), key, inside, rule);
  };
  return {true, of("storage_modulus"), of("loss_modulus")};
}

double given_reference_temperature(const Json& object, const std::string& place) {
  const auto found = object.find("reference_temperature");
  if (found == object.end()) return usual_reference_temperature;
  if (found->is_number()) {
    const Quantity& quantity = find_input("reference_temperature")->quantity;
    if (const std::string doubt = doubt_of(quantity, found->get<double>()); !doubt.empty())
      refuse(place, "reference_temperature", *found, doubt);
    return found->get<double>();
  }
  try {
    if (found->is_string()) return kelvin(found->get_ref<const std::string&>());
  } catch (const std::invalid_argument&) {  // refused below
  }
  refuse(place, "reference_temperature", *found, "must be a temperature > 0 in K, or a text with K or degC");
}

std::string given_scene(const Json& object, const std::filesystem::path& file, const std::string& place) {
  if (!object.contains("scene")) return "";
  const CompleteScene scene = complete_scene(object, file, place);
  scene_entries(scene.inputs, {}, scene.place);
  return scene.inputs.dump();
}

namespace {

/// @throws std::invalid_argument "WHERE: temperature = 240: must be within shift_temperatures, ..."
void refuse_beyond(const TemperatureShift& shift, double temperature, const std::string& where) {
  MaterialInputs layer;
  layer.static_shear_modulus = 1;
  layer.shift_temperatures = shift.table.temperatures;
  layer.shift_factors = shift.table.factors;
  layer.modulus_shifts = shift.table.moduli;
  layer.temperature = temperature;
  layer.reference_temperature = shift.reference;
  if (const auto broken = check_material(layer); !broken.empty())
    throw std::invalid_argument(where + ": " + broken.front());
}

/// What the key says of the table's moduli, if it is there.
std::optional<ListedModuli> given_listed_moduli(const Json& object, const std::string& place) {
  const std::string key(listed_moduli_key), former = "modulus";
  if (object.contains(key) && object.contains(former))
    refuse(place, former, object[former], "is the former name of " + key + ": leave out one of them");
  for (const std::string& name : {key, former})
    if (object.contains(name)) return choice_or_first<ListedModuli>(object, name, place);
  return std::nullopt;
}

/// The shift of a fit's file: a law whose constants are fitted, or a measured table.
/// @param text  of the table, at whose end that of the table of shifts is put
TemperatureShift given_shift(const Json& object, const std::filesystem::path& file, const std::string& place,
                             std::string& text) {
  const std::string law = name_or_first(object, "shift", shift_names, place), key{shift_table_key};
  // In the order of the laws; what is free becomes a table.
  TemperatureShift shift{.law = static_cast<ShiftLaw>(find_name(shift_names, law)),
                         .reference = given_reference_temperature(object, place)};
  if (!object.contains(key)) return shift;
  if (law == free_shift) refuse(place, "shift", object["shift"], "has no place beside " + key);
  const auto name = file.parent_path() / needed_text(object, key, place, "must be the name of a CSV file");
  const Json lists = read_shift_table(name, names_or_none(object, std::string(ignored_columns_key), place));
  const auto list = [&](std::string_view input) {
    const auto found = lists.find(std::string(input));
    return found == lists.end() ? std::vector<double>() : found->get<std::vector<double>>();
  };
  shift.table = {list(shift_table_inputs[0]), list(shift_table_inputs[1]), list(shift_table_inputs[2])};
  refuse_beyond(shift, shift.reference, name.string());
  text += read_measured_table(name).text;
  if (shift.table.factors.empty()) return shift;
  if (shift.law != ShiftLaw::none)
    refuse(place, "shift", object["shift"], "a_T is in the " + key + ": leave out one of them");
  shift.law = ShiftLaw::table;
  return shift;
}

/// The reference of free shifts lies within the temperatures that are measured.
void refuse_reference_beyond(const MaterialFile& fit, const std::string& place) {
  TemperatureShift measured = fit.options.shift;
  measured.table.temperatures = steps_of_temperature(fit.data);
  measured.table.factors.assign(measured.table.temperatures.size(), 1);
  refuse_beyond(measured, measured.table.temperatures.front(), place);
}

}  // namespace

AloneFit given_name(const Json& object, std::span<const FileKey> keys, const std::string& place) {
  require_kind(FileKind::fit, object, place);
  refuse_unknown_keys(object, keys, place);
  return {.name = needed_name(object, "fit", place, "must be the name of the fit"), .definition = object.dump(2)};
}

FitOptions given_descents(const Json& object, const std::string& place) {
  FitOptions options;
  options.starts = whole_number_or(object, "starts", 1, 1, 1000, place);
  options.seed = static_cast<std::uint64_t>(whole_number_or(object, "seed", 1, 0, 2'000'000'000, place));
  return options;
}

void note_left_out(AloneFit& fit, const Json& object, const std::vector<std::string>& columns) {
  if (!columns.empty())
    fit.notes.push_back("columns of " + object["data"].get<std::string>() + " left out: " + joined(columns));
}

FitKind kind_of_fit(const std::filesystem::path& file) {
  const Json object = read_object(file.string());
  const auto material = object.find("material");
  if (material == object.end()) return FitKind::resistance;
  return *material == shift_alone ? FitKind::shift : *material == kraus_alone ? FitKind::strain : FitKind::material;
}

MaterialFile read_material_fit(const std::filesystem::path& file) {
  const std::string place = file.string();
  const Json object = read_object(place);
  MaterialFile fit{given_name(object, material_fit_keys, place)};
  fit.options.form = choice_or_first<MaterialForm>(object, "material", place);
  if (const auto terms = object.find("terms"); terms != object.end() && *terms != "auto")
    fit.options.terms = whole_number_or(object, "terms", 0, 1, 100, place);
  if (object.contains("times")) fit.options.times = given_times(object, fit.options, place);
  fit.options.options = given_descents(object, place);
  const ModulusSigmas sigma = given_modulus_sigmas(object, place);
  fit.options.deviations_known = sigma.known;

  fit.scene = given_scene(object, file, place);

  const std::string name = needed_text(object, "data", place, "must be the name of a CSV file");
  MeasuredTable table = read_measured_table(file.parent_path() / name);
  std::string text = table.text;
  fit.options.shift = given_shift(object, file, place, text);
  fit.options.free_shifts = fit.options.shift.law == ShiftLaw::table && fit.options.shift.table.temperatures.empty();
  if (object.contains("vertical_shift")) {
    if (!fit.options.free_shifts)
      refuse(place, "vertical_shift", object["vertical_shift"], "needs \"shift\": \"free\"");
    fit.options.vertical = choice_or_first<VerticalShift>(object, "vertical_shift", place);
  }
  fit.data_digest = digest(text);
  table.leave_out(names_or_none(object, std::string(ignored_columns_key), place));
  fit.notes.push_back(table.in_words());
  const ListedModuli listed =
      said_moduli(take_modulus_names(table), given_listed_moduli(object, place), name, storage_modulus_key, place);
  const double share = listed == ListedModuli::young ? 1.0 / 3 : 1;
  if (object.contains("modulus")) fit.notes.emplace_back("modulus is the former name of listed_moduli");
  std::vector<std::string_view> known(modulus_columns.begin(), modulus_columns.end());
  known.emplace_back("temperature");
  note_left_out(fit, object, table.leave_out_others(known));
  const std::vector<double> frequencies = measured_frequencies(table);
  const auto [storage, loss] = measured_moduli(table, positive);
  const TemperatureShift& shift = fit.options.shift;
  const bool shifted = shift.law != ShiftLaw::none, tabled = !shift.table.temperatures.empty();
  const MeasuredColumn* const temperature =
      shifted || tabled ? &table.needed("temperature") : table.find("temperature");
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double here = temperature ? measured_number(table, *temperature, row, "K") : shift.reference;
    const std::string cell = temperature ? heading(*temperature) + " = " + temperature->cells[row] : "";
    if (tabled) refuse_beyond(shift, here, table.place(row));
    const double factor = share * modulus_factor(shift, here);
    fit.data.push_back({.angular_frequency = 2 * std::numbers::pi * frequencies[row],
                        .temperature = here,
                        .storage = factor * storage[row],
                        .loss = factor * loss[row],
                        .storage_deviation = sigma.storage * factor * storage[row],
                        .loss_deviation = sigma.loss * factor * loss[row],
                        .place = table.place(row)});
    if (temperature && !shifted && here != fit.data.front().temperature)
      throw std::invalid_argument(
          table.place(row) + ": " + cell +
          ": several temperatures need a shift (free, wlf, arrhenius or vft) or a table of a_T");
  }
  if (fit.options.free_shifts) refuse_reference_beyond(fit, place);
  if (tabled)
    fit.notes.push_back("shifts of " + needed_text(object, std::string(shift_table_key), place, "") +
                        (shifted && shift.law == ShiftLaw::table ? ": frequencies are reduced by a_T" : "") +
                        (shift.table.moduli.empty() ? "" : "; moduli are those of the data times b_T"));
  return fit;
}

}  // namespace rollres
