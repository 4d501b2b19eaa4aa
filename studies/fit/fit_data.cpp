#include "studies/fit/fit_data.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

#include "core/material/passivity.hpp"
#include "core/messages/message_text.hpp"
#include "core/model/scene_rules.hpp"
#include "core/scene/scene_input.hpp"
#include "db/rows/result_store.hpp"
#include "studies/fit/fit_keys.hpp"
#include "studies/scene_io/doubtful_number.hpp"
#include "studies/scene_io/master_curve_file.hpp"
#include "studies/scene_io/scene_overrides.hpp"
#include "studies/study/study_scene.hpp"
#include "studies/text/measured_table.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/units.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

constexpr std::string_view moduli_name = "moduli";

/// The output that is measured, or "moduli".
std::string output_name(const Json& object, const std::string& place) {
  const std::string name = needed_text(object, "output", place,
                                       "must be the key of an output, moduli, relaxation_modulus or creep_compliance");
  if (name != moduli_name && !is_curve(name)) refusing_at(place + ": output", [&] { return real_output(name); });
  return name;
}

GivenSet given_set(const Json& value, const std::filesystem::path& fit_file, const std::string& fit_place) {
  const std::string place = fit_place + ": data";
  const auto beside = [&](const std::string& file) { return (fit_file.parent_path() / file).string(); };
  if (value.is_string() && !value.get_ref<const std::string&>().empty()) {
    const auto file = value.get<std::string>();
    return {.name = std::filesystem::path(file).stem().string(), .file = beside(file), .place = place};
  }
  if (!value.is_object()) refuse(fit_place, "data", value, "must be the name of a CSV file, an object or a list");
  refuse_unknown_keys(value, data_set_keys, place);
  const std::string file = needed_text(value, "file", place, "must be the name of a CSV file");
  GivenSet given{.name = std::filesystem::path(file).stem().string(), .file = beside(file), .place = place};
  if (value.contains("name")) given.name = needed_name(value, "name", place, "must be a name");
  given.set = set_entries(value, place);
  if (value.contains("output")) given.output = output_name(value, place);
  given.ignored = names_or_none(value, std::string(ignored_columns_key), place);
  if (const std::string key(listed_moduli_key); value.contains(key)) {
    given.listed_moduli = choice_or_first<ListedModuli>(value, key, place);
    if (given.output != moduli_name && !is_curve(given.output))
      refuse(place, key, value[key], "is for output: moduli, relaxation_modulus or creep_compliance");
  }
  if (const auto sigma = value.find("sigma"); sigma != value.end()) {
    given.sigma = *sigma;
    if (sigma->is_object()) {
      if (given.output != moduli_name) refuse(place, "sigma", *sigma, "one for each modulus needs output: moduli");
      refuse_unknown_keys(*sigma, modulus_sigma_keys, place + ": sigma");
    }
  }
  return given;
}

}  // namespace

std::vector<GivenSet> given_sets(const Json& fit, const std::filesystem::path& file, const std::string& place) {
  const Json& data = needed(fit, "data", place, "must be the name of a CSV file, an object or a list");
  std::vector<GivenSet> sets;
  if (data.is_array() && !data.empty())
    for (const Json& item : data) sets.push_back(given_set(item, file, place));
  else
    sets.push_back(given_set(data, file, place));
  for (std::size_t i = 0; i < sets.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (sets[i].name == sets[j].name)
        throw std::invalid_argument(place + ": data: name = \"" + sets[i].name + "\": given twice");
  return sets;
}

SceneEntry column_entry(const MeasuredTable& table, const MeasuredColumn& column, std::size_t row) {
  const std::string& cell = column.cells[row];
  const InputKind& kind = *find_input(column.name);
  SceneEntry entry{column.name, cell, table.place(row)};
  if (!kind.choices.empty() || (kind.quantity.range.infinity_allowed && cell == "infinite")) return entry;
  const bool dimensionless = kind.quantity.unit == "1";
  if (cell.empty() || !plain_number(cell) || dimensionless || column.unit.empty())
    entry.value = measured_number(table, column, row, dimensionless ? "1" : kind.quantity.unit);
  else
    entry.value = cell + " " + column.unit;  // its unit may depend on the body
  return entry;
}

bool smooth_without_spacing(const RollingScene& scene) {
  if (!scene.spacing) return false;
  if (dimension_of(scene.indenter) == 3) return scene.method == Method::automatic || scene.method == Method::newton;
  RollingScene free = scene;
  free.spacing.reset();
  return resolved_method(free) == Method::spectral;
}

namespace {

/// A standard deviation: of its own, or relative to the measured value.
struct Sigma {
  double value;
  bool relative;
  double of(double measured) const { return relative ? value * std::abs(measured) : value; }
};

Sigma given_sigma(const Json& value, std::string_view unit, const std::string& place) {
  const std::string rule = "must be > 0: a percentage (\"2 %\"), or have " + unit_in_words(unit);
  Sigma sigma{0, false};
  if (value.is_number()) {
    sigma.value = value.get<double>();
    if (const std::string doubt = doubt_of_measured(unit, sigma.value); !doubt.empty())
      refuse(place, "sigma", value, doubt);
  } else if (value.is_string()) {
    const auto& text = value.get_ref<const std::string&>();
    if (const auto part = percentage(text))
      sigma = {*part, true};
    else
      try {
        sigma.value = si_value(text, unit);
      } catch (const std::invalid_argument&) {
        refuse(place, "sigma", value, rule);
      }
  }
  if (!(sigma.value > 0)) refuse(place, "sigma", value, rule);
  return sigma;
}

/// @param others  outputs that other data sets read from the same table
void refuse_unknown_columns(const MeasuredTable& table, const std::vector<std::string>& others, bool moduli,
                            bool timed) {
  const auto known_beside = [&](const MeasuredColumn& column) {
    std::vector<std::string_view> known = keys_like(column.name);
    std::erase_if(known, [](std::string_view key) { return find_input(key)->list; });
    if (held_key(column.name) != column.name) known.emplace_back(column.name);
    known.insert(known.end(), others.begin(), others.end());
    known.insert(known.end(), {"sigma", "note"});
    if (moduli) known.insert(known.end(), {"frequency", "angular_frequency", storage_modulus_key, loss_modulus_key});
    if (timed) known.insert(known.end(), "time");
    return known;
  };
  table.refuse_others(known_beside, "ignore_columns of the data set leaves it out");
}

/// The standard deviation that a row's value has, or what its residual is measured in, and whether it is relative.
struct Deviation {
  double value;
  bool relative;
};

Deviation deviation_of(const FitFile& fit, const GivenSet& set, const MeasuredTable& table,
                       const MeasuredColumn& output, std::size_t row, double value, std::string_view unit) {
  const MeasuredColumn* const deviations = table.find("sigma");
  const std::string place = table.place(row);
  if (deviations) {
    const bool relative = deviations->unit == "%";
    MeasuredColumn column = *deviations;
    if (column.unit.empty()) column.unit = output.unit;
    if (relative) column.unit = "";
    const Sigma sigma{measured_number(table, column, row, relative ? "1" : unit) / (relative ? 100 : 1), relative};
    if (!(sigma.of(value) > 0))
      throw std::invalid_argument(place + ": " + heading(*deviations) + " = " + deviations->cells[row] +
                                  ": must be > 0");
    return {sigma.of(value), relative};
  }
  if (set.sigma) {
    const bool of_each = set.sigma->is_object();  // one for storage and one for loss moduli
    const std::string place_of_each = set.place + ": sigma";
    const Sigma sigma =
        of_each ? given_sigma(needed(*set.sigma, output.name, place_of_each, "must be a standard deviation"), unit,
                              place_of_each)
                : given_sigma(*set.sigma, unit, set.place);
    return {sigma.of(value), sigma.relative};
  }
  if (fit.relative_weights) return {std::abs(value), true};
  return {1, false};
}

void add_value(FitFile& fit, const GivenSet& set, const MeasuredTable& table, const MeasuredColumn& output,
               std::size_t row, MeasuredScene measured) {
  const std::string place = table.place(row);
  const std::string_view unit = measured_quantity(measured.output).unit_for(body_of(measured.scene));
  const double value = measured_number(table, output, row, unit);
  const Deviation deviation = deviation_of(fit, set, table, output, row, value, unit);
  if (deviation.relative && !(value > 0))
    throw std::invalid_argument(place + ": " + heading(output) + " = " + output.cells[row] +
                                ": must be > 0 where deviations are relative to it");
  if (value < 0) fit.warnings.push_back(place + ": " + heading(output) + " = " + output.cells[row] + ": is negative");
  measured.measured = {.value = value, .deviation = deviation.value, .place = place};
  fit.scenes.push_back(std::move(measured));
}

/// Leaves out the scene's own spacing where there are smooth answers without it.
void leave_out_spacing(FitFile& fit, RollingScene& scene) {
  if (!smooth_without_spacing(scene)) return;
  if (fit.notes.empty())
    fit.notes.push_back("spacing = " + readable(*scene.spacing, "m") +
                        " of the scene left out, for answers without a grid's jumps: " +
                        (dimension_of(scene.indenter) == 3 ? "the grid is tied to the contact"
                                                           : "the edges of contact are continuous"));
  scene.spacing.reset();
}

/// Puts the loss tangent of a table, beside one modulus, into the place of the other; beside both it is left out.
void replace_loss_tangent(MeasuredTable& table) {
  std::vector<std::string> tangents;
  for (const MeasuredColumn& column : table.columns)
    if (column.name == "loss_tangent" || column.name == "tan_delta") tangents.push_back(column.name);
  if (tangents.empty()) return;
  const MeasuredModuli moduli = measured_moduli(table, positive);
  table.leave_out(tangents);
  for (const auto& [key, values] :
       {std::pair(storage_modulus_key, &moduli.storage), std::pair(loss_modulus_key, &moduli.loss)}) {
    if (!table.find(key)) table.columns.push_back({std::string(key), "Pa", {}, *values});
  }
}

/// Reads the rows of one data set into the fit. @param keep_spacing  the fit's own set has one
/// @param others  outputs that data sets read from the same table   @param said  of moduli by the names of columns
void read_rows(FitFile& fit, const GivenSet& set, const std::vector<SceneEntry>& base, bool keep_spacing,
               const MeasuredTable& table, const std::vector<std::string>& others, std::optional<ListedModuli> said) {
  const std::string output = set.output.empty() ? fit.output : set.output;
  const bool moduli = output == moduli_name, timed = is_curve(output), first = fit.scenes.empty();
  refuse_unknown_columns(table, others, moduli, timed);
  if (table.find("sigma") && set.sigma) refuse(set.place, "sigma", *set.sigma, "the table has a column sigma too");
  std::vector<const MeasuredColumn*> columns;
  if (moduli) {
    for (const std::string_view key : {storage_modulus_key, loss_modulus_key})
      if (const MeasuredColumn* const column = table.find(key)) columns.push_back(column);
    if (columns.empty()) columns.push_back(&table.needed(storage_modulus_key));
  } else {
    columns.push_back(&table.needed(output));
  }
  ListedModuli listed = ListedModuli::shear;
  if (moduli || timed)
    listed = said_moduli(said, set.listed_moduli, std::filesystem::path(table.file).filename().string(),
                         columns.front()->name, set.place);
  const MeasuredColumn* const sigma = table.find("sigma");
  if (sigma && sigma->unit.empty() && columns.front()->unit != columns.back()->unit)
    throw std::invalid_argument(table.file +
                                ": sigma: must have its unit in the heading, as \"sigma [%]\", where storage and loss "
                                "modulus do not have the same one");
  const std::vector<double> frequencies = moduli ? measured_frequencies(table) : std::vector<double>();
  const std::vector<double> times =
      timed ? measured_numbers(table, table.needed("time"), "s", positive) : std::vector<double>();
  const std::vector<SceneEntry> common = overridden(base, set.set);
  const auto is_other = [&](const MeasuredColumn& column) { return contains(others, column.name); };
  for (std::size_t row = 0; row < table.rows(); ++row) {
    std::vector<SceneEntry> own;
    for (const MeasuredColumn& column : table.columns)
      if (find_input(column.name) && !is_other(column)) own.push_back(held_entry(column_entry(table, column, row)));
    const std::string place = table.place(row);
    RollingScene scene = scene_from(overridden(common, own), place);
    if (!keep_spacing && !value_given(set.set, "spacing") && !value_given(own, "spacing"))
      leave_out_spacing(fit, scene);
    if (!fit.scenes.empty() && scene.indenter != fit.body().indenter)
      throw std::invalid_argument(place + ": indenter: must be the same in all rows");
    if (!fit.scenes.empty() && body_of(scene) != fit.body())
      throw std::invalid_argument(place + ": width: must be given in all rows or in none");
    for (const MeasuredColumn* const column : columns)
      add_value(fit, set, table, *column, row,
                {.scene = scene,
                 .measured = {},
                 .set = set.name,
                 .output = moduli ? column->name : output,
                 .angular_frequency = moduli ? 2 * std::numbers::pi * frequencies[row] : RollingSolution::absent,
                 .time = timed ? times[row] : RollingSolution::absent,
                 .listed_moduli = listed});
  }
  if (columns.size() == 2)
    if (const std::string swapped = swapped_moduli(measured_numbers(table, *columns[0], "Pa", {}),
                                                   measured_numbers(table, *columns[1], "Pa", {}));
        !swapped.empty())
      fit.warnings.push_back(table.file + ": " + swapped);
  const bool known = table.find("sigma") || set.sigma;
  if (!first && known != fit.deviations_known)
    throw std::invalid_argument((known ? fit.source : table.file) +
                                ": sigma is missing: give it for all data sets or for none");
  fit.deviations_known = known;
  for (const MeasuredColumn& column : table.columns)
    if (find_input(column.name) && !is_other(column) && !contains(fit.varying, held_key(column.name)))
      fit.varying.push_back(held_key(column.name));
}

}  // namespace

std::string read_data(FitFile& fit, const std::vector<GivenSet>& sets, const std::vector<SceneEntry>& base,
                      bool keep_spacing) {
  std::string all_text;
  for (const GivenSet& set : sets) {
    MeasuredTable table = read_measured_table(set.file);
    table.leave_out(set.ignored);
    const std::optional<ListedModuli> said = take_modulus_names(table);
    if (set.output == moduli_name) replace_loss_tangent(table);
    all_text += table.text + '\n';
    std::vector<std::string> others;
    for (const GivenSet& other : sets)
      if (other.file == set.file) others.push_back(other.output.empty() ? fit.output : other.output);
    read_rows(fit, set, base, keep_spacing, table, others, said);
  }
  return all_text;
}

void warn_of_equal_weights(FitFile& fit) {
  if (fit.deviations_known || fit.relative_weights || !fit.noise.empty()) return;
  constexpr double far_apart = 20;
  std::map<std::string, std::pair<double, double>> sizes;  // least and largest of each output
  for (const MeasuredScene& row : fit.scenes) {
    const double size = std::abs(row.measured.value);
    if (!(size > 0)) continue;
    const auto [place, first] = sizes.try_emplace(row.output, size, size);
    place->second = {std::min(place->second.first, size), std::max(place->second.second, size)};
  }
  for (const auto& [output, size] : sizes)
    if (size.second > far_apart * size.first)
      fit.warnings.push_back(
          output + " from " + short_number(size.first, 3) + " to " + short_number(size.second, 3) + " " +
          std::string(measured_quantity(output).unit_for(fit.body())) +
          " without a sigma: all count as if they had the same error in this unit, so that the small ones tell "
          "nothing; \"weights\": \"relative\" gives all the same relative error, a column \"sigma [%]\" tells it");
}

void warn_of_repeated_rows(FitFile& fit) {
  std::map<std::string, const MeasuredScene*> seen;
  for (const MeasuredScene& row : fit.scenes) {
    const auto [place, fresh] = seen.try_emplace(
        evaluation_key(row.scene) + row.set + row.output + message_text<17>(row.angular_frequency, " ", row.time),
        &row);
    if (fresh) continue;
    const bool same = place->second->measured.value == row.measured.value;
    if (same)
      fit.warnings.push_back(row.measured.place + ": the same row as " + place->second->measured.place +
                             "; both count");
  }
}

}  // namespace rollres
