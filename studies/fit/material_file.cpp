#include "studies/fit/material_file.hpp"

#include <array>
#include <numbers>
#include <stdexcept>

#include "db/file/digest.hpp"
#include "studies/fit/fit_keys.hpp"
#include "studies/scene_io/master_curve_file.hpp"
#include "studies/scene_io/scene_entries.hpp"
#include "studies/study/study_scene.hpp"
#include "studies/text/file_kind.hpp"
#include "studies/text/strict_json.hpp"
#include "studies/text/units.hpp"

namespace rollres {

namespace {

constexpr double usual_reference_temperature = 293.15;  // [K]: 20 degC

double relative_sigma(const Json& value, const std::string& key, const std::string& place, const char* rule) {
  if (value.is_string())
    if (const auto part = percentage(value.get_ref<const std::string&>()); part && *part > 0) return *part;
  refuse(place, key, value, rule);
}

/// Relative deviations of storage and loss moduli, 1 if none are given.
struct Sigmas {
  bool known = false;
  double storage = 1, loss = 1;
};
Sigmas given_sigmas(const Json& object, const std::string& place) {
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

SeriesTimes given_times(const Json& object, const MaterialFitOptions& options, const std::string& place) {
  const auto times = choice_or_first<SeriesTimes>(object, "times", place);
  if (times == SeriesTimes::free && (options.terms == 0 || options.terms > most_free_terms))
    refuse(place, "times", object.at("times"), "needs a number of terms from 1 to " + std::to_string(most_free_terms));
  return times;
}

}  // namespace

double given_reference_temperature(const Json& object, const std::string& place) {
  const auto found = object.find("reference_temperature");
  if (found == object.end()) return usual_reference_temperature;
  if (found->is_number() && *found > 0) return found->get<double>();
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

bool is_material_fit(const std::filesystem::path& file) { return read_object(file.string()).contains("material"); }

MaterialFile read_material_fit(const std::filesystem::path& file) {
  const std::string place = file.string();
  const Json object = read_object(place);
  require_kind(FileKind::fit, object, place);
  refuse_unknown_keys(object, material_fit_keys, place);
  MaterialFile fit;
  fit.name = needed_name(object, "fit", place, "must be the name of the fit");
  fit.definition = object.dump(2);
  fit.options.form = choice_or_first<MaterialForm>(object, "material", place);
  if (const auto terms = object.find("terms"); terms != object.end() && *terms != "auto")
    fit.options.terms = whole_number_or(object, "terms", 0, 1, 100, place);
  if (object.contains("times")) fit.options.times = given_times(object, fit.options, place);
  const std::string law = name_or_first(object, "shift", shift_names, place);
  fit.options.shift.law = static_cast<ShiftLaw>(find_name(shift_names, law));
  fit.options.shift.reference = given_reference_temperature(object, place);
  fit.options.options.starts = whole_number_or(object, "starts", 1, 1, 1000, place);
  fit.options.options.seed = static_cast<std::uint64_t>(whole_number_or(object, "seed", 1, 0, 2'000'000'000, place));
  const double share = name_or_first(object, "modulus", modulus_names, place) == "young" ? 1.0 / 3 : 1;
  const Sigmas sigma = given_sigmas(object, place);
  fit.options.deviations_known = sigma.known;

  fit.scene = given_scene(object, file, place);

  const std::string name = needed_text(object, "data", place, "must be the name of a CSV file");
  MeasuredTable table = read_measured_table(file.parent_path() / name);
  fit.data_digest = digest(table.text);
  table.leave_out(names_or_none(object, std::string(ignored_columns_key), place));
  std::vector<std::string_view> known(modulus_columns.begin(), modulus_columns.end());
  known.emplace_back("temperature");
  if (const std::vector<std::string> others = table.leave_out_others(known); !others.empty())
    fit.notes.push_back("columns of " + name + " left out: " + joined(others));
  const std::vector<double> frequencies = measured_frequencies(table);
  const auto [storage, loss] = measured_moduli(table, positive);
  const bool shifted = fit.options.shift.law != ShiftLaw::none;
  const MeasuredColumn* const temperature = shifted ? &table.needed("temperature") : table.find("temperature");
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double here = temperature ? measured_number(table, *temperature, row, "K") : fit.options.shift.reference;
    fit.data.push_back({.angular_frequency = 2 * std::numbers::pi * frequencies[row],
                        .temperature = here,
                        .storage = share * storage[row],
                        .loss = share * loss[row],
                        .storage_deviation = sigma.storage * share * storage[row],
                        .loss_deviation = sigma.loss * share * loss[row],
                        .place = table.place(row)});
    if (temperature && !shifted && here != fit.data.front().temperature)
      throw std::invalid_argument(table.place(row) + ": " + heading(*temperature) + " = " + temperature->cells[row] +
                                  ": several temperatures need a shift (wlf or arrhenius)");
  }
  return fit;
}

}  // namespace rollres
