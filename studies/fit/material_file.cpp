#include "studies/fit/material_file.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "db/file/digest.hpp"
#include "studies/fit/fit_keys.hpp"
#include "studies/scene_io/master_curve_file.hpp"
#include "studies/text/file_kind.hpp"
#include "studies/text/strict_json.hpp"
#include "studies/text/units.hpp"

namespace rollres {

namespace {

constexpr double usual_reference_temperature = 293.15;  // [K]: 20 degC

double reference_temperature(const Json& object, const std::string& place) {
  const auto found = object.find("reference_temperature");
  if (found == object.end()) return usual_reference_temperature;
  if (found->is_number() && *found > 0) return found->get<double>();
  try {
    if (found->is_string()) return kelvin(found->get_ref<const std::string&>());
  } catch (const std::invalid_argument&) {  // refused below
  }
  refuse(place, "reference_temperature", *found, "must be a temperature > 0 in K, or a text with K or degC");
}

/// The relative deviation; NaN if none is given.
double relative_sigma(const Json& object, const std::string& place) {
  const auto found = object.find("sigma");
  if (found == object.end()) return std::nan("");
  if (found->is_string())
    if (const auto part = percentage(found->get_ref<const std::string&>()); part && *part > 0) return *part;
  refuse(place, "sigma", *found, "must be a percentage > 0: \"2 %\"");
}

}  // namespace

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
  const std::string law = name_or_first(object, "shift", shift_names, place);
  fit.options.shift.law = static_cast<ShiftLaw>(find_name(shift_names, law));
  fit.options.shift.reference = reference_temperature(object, place);
  fit.options.options.starts = whole_number_or(object, "starts", 1, 1, 1000, place);
  fit.options.options.seed = static_cast<std::uint64_t>(whole_number_or(object, "seed", 1, 0, 2'000'000'000, place));
  const double share = name_or_first(object, "modulus", modulus_names, place) == "young" ? 1.0 / 3 : 1;
  const double sigma = relative_sigma(object, place);
  fit.options.deviations_known = std::isfinite(sigma);

  const std::string name = needed_text(object, "data", place, "must be the name of a CSV file");
  const MeasuredTable table = read_measured_table(file.parent_path() / name);
  fit.data_digest = digest(table.text);
  table.refuse_others(std::array<std::string_view, 6>{"frequency", "angular_frequency", "storage_modulus",
                                                      "loss_modulus", "temperature", "note"});
  const std::vector<double> frequencies = measured_frequencies(table);
  const std::vector<double> storage = measured_numbers(table, table.needed("storage_modulus"), "Pa", positive);
  const std::vector<double> loss = measured_numbers(table, table.needed("loss_modulus"), "Pa", positive);
  const bool shifted = fit.options.shift.law != ShiftLaw::none;
  const MeasuredColumn* const temperature = shifted ? &table.needed("temperature") : table.find("temperature");
  const double weight = fit.options.deviations_known ? sigma : 1;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double here = temperature ? measured_number(table, *temperature, row, "K") : fit.options.shift.reference;
    fit.data.push_back({.angular_frequency = 2 * std::numbers::pi * frequencies[row],
                        .temperature = here,
                        .storage = share * storage[row],
                        .loss = share * loss[row],
                        .storage_deviation = weight * share * storage[row],
                        .loss_deviation = weight * share * loss[row],
                        .place = table.place(row)});
    if (temperature && !shifted && here != fit.data.front().temperature)
      throw std::invalid_argument(table.place(row) + ": " + heading(*temperature) + " = " + temperature->cells[row] +
                                  ": several temperatures need a shift (wlf or arrhenius)");
  }
  return fit;
}

}  // namespace rollres
