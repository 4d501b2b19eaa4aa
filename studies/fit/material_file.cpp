#include "studies/fit/material_file.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "db/file/digest.hpp"
#include "studies/fit/fit_keys.hpp"
#include "studies/scene_io/master_curve_file.hpp"
#include "studies/text/file_kind.hpp"
#include "studies/text/measured_table.hpp"
#include "studies/text/strict_json.hpp"
#include "studies/text/units.hpp"

namespace rollres {

namespace {

constexpr double ice_point = 273.15;  // [K]

/// [K]
double kelvin(const MeasuredTable& table, const MeasuredColumn& column, std::size_t row) {
  if (column.unit != "degC" && column.unit != "°C") return measured_number(table, column, row, "K");
  MeasuredColumn plain = column;
  plain.unit = "";
  return measured_number(table, plain, row, "1") + ice_point;
}

double reference_temperature(const Json& object, const std::string& place) {
  const auto found = object.find("reference_temperature");
  if (found == object.end()) return ice_point + 20;
  if (found->is_string()) {
    const auto& text = found->get_ref<const std::string&>();
    for (const std::string_view unit : {" degC", " °C"})
      if (text.ends_with(unit))
        if (const auto number = plain_number(text.substr(0, text.size() - unit.size()))) return *number + ice_point;
    try {
      return si_value(text, "K");
    } catch (const std::invalid_argument&) {
    }
  }
  if (found->is_number() && *found > 0) return found->get<double>();
  refuse(place, "reference_temperature", *found, "must be a temperature > 0 in K, or a text with K or degC");
}

/// The relative deviation; NaN if none is given.
double relative_sigma(const Json& object, const std::string& place) {
  const auto found = object.find("sigma");
  if (found == object.end()) return std::nan("");
  if (found->is_string() && found->get_ref<const std::string&>().ends_with('%')) {
    const auto& text = found->get_ref<const std::string&>();
    if (const auto part = plain_number(text.substr(0, text.size() - 1)); part && *part > 0) return *part / 100;
  }
  refuse(place, "sigma", *found, "must be a percentage > 0: \"2 %\"");
}

const MeasuredColumn& needed_column(const MeasuredTable& table, const char* name) {
  const MeasuredColumn* const column = table.find(name);
  if (!column) throw std::invalid_argument(table.file + ": has no column " + name);
  return *column;
}

double positive_number(const MeasuredTable& table, const MeasuredColumn& column, std::size_t row,
                       std::string_view unit) {
  const double number = measured_number(table, column, row, unit);
  if (!(number > 0))
    throw std::invalid_argument(table.place(row) + ": " + heading(column) + " = " + column.cells[row] +
                                ": must be > 0");
  return number;
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
  constexpr std::string_view columns[] = {"frequency",    "angular_frequency", "storage_modulus",
                                          "loss_modulus", "temperature",       "note"};
  for (const MeasuredColumn& column : table.columns)
    if (find_name(columns, column.name) < 0)
      throw std::invalid_argument(table.file + ": " + column.name + ": " +
                                  unknown("unknown column", columns, column.name));
  const MeasuredColumn* const turns = table.find("frequency");
  const MeasuredColumn& frequency = turns ? *turns : needed_column(table, "angular_frequency");
  const MeasuredColumn &storage = needed_column(table, "storage_modulus"), &loss = needed_column(table, "loss_modulus");
  const MeasuredColumn* const temperature = table.find("temperature");
  if (fit.options.shift.law != ShiftLaw::none) needed_column(table, "temperature");
  const double weight = fit.options.deviations_known ? sigma : 1;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    MeasuredModulus measured;
    measured.angular_frequency = turns ? 2 * std::numbers::pi * positive_number(table, frequency, row, "Hz")
                                       : positive_number(table, frequency, row, "rad/s");
    if (!frequency_range.contains(measured.angular_frequency / (2 * std::numbers::pi)))
      throw std::invalid_argument(table.place(row) + ": " + heading(frequency) + " = " + frequency.cells[row] + ": " +
                                  frequency_range.rule() + " Hz");
    measured.temperature = temperature ? kelvin(table, *temperature, row) : fit.options.shift.reference;
    measured.storage = share * positive_number(table, storage, row, "Pa");
    measured.loss = share * positive_number(table, loss, row, "Pa");
    measured.storage_deviation = weight * measured.storage;
    measured.loss_deviation = weight * measured.loss;
    measured.place = table.place(row);
    if (temperature && fit.options.shift.law == ShiftLaw::none && row > 0 &&
        measured.temperature != fit.data.front().temperature)
      throw std::invalid_argument(measured.place + ": " + heading(*temperature) + " = " + temperature->cells[row] +
                                  ": several temperatures need a shift (wlf or arrhenius)");
    fit.data.push_back(measured);
  }
  return fit;
}

}  // namespace rollres
