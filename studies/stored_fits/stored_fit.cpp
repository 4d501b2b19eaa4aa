#include "studies/stored_fits/stored_fit.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "db/rows/fit_columns.hpp"
#include "studies/run/progress.hpp"
#include "studies/scene_io/cells.hpp"
#include "studies/stored/accepted_study.hpp"
#include "studies/text/files.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/table_json.hpp"
#include "studies/text/table_output.hpp"
#include "studies/text/value_and_error.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

/// @param lowest, highest  an end that is absent is open
std::string interval_in_words(double lowest, double highest, const std::string& unit) {
  const auto end = [&](double value) { return std::isnan(value) ? std::string("open") : readable(value, unit); };
  return end(lowest) + " .. " + end(highest);
}

std::string four_digits(double value) { return std::isfinite(value) ? short_number(value, 4) : "-"; }

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream rest(text);
  for (std::string line; std::getline(rest, line);) lines.push_back(line);
  return lines;
}

/// A list of names, cut off where it is long.
std::string few(const std::string& names) {
  constexpr std::size_t longest = 60;
  if (names.size() <= longest) return names;
  const std::vector<std::string> all = split_at_commas(names);
  return all.front() + ", " + all[1] + " and " + std::to_string(all.size() - 2) + " others";
}

/// A column as a cell; absent where a number is, or a count is none (< 0).
Cell column_cell(double value) { return cell_of(value); }
Cell column_cell(std::int64_t count) { return count < 0 ? Cell() : Cell(count); }
Cell column_cell(bool yes) { return std::int64_t{yes}; }
Cell column_cell(const std::string& text) { return text; }

/// All columns of the records, for other programs.
template <class Record>
Table record_table(const std::vector<Record>& records) {
  Table table;
  const Record any{};
  visit_columns(any, [&](const char* name, const auto&) { table.columns.emplace_back(name); });
  for (const Record& record : records) {
    std::vector<Cell>& row = table.rows.emplace_back();
    visit_columns(record, [&](const char*, const auto& value) { row.push_back(column_cell(value)); });
  }
  return table;
}

/// With a column for each input, in SI.
Table data_of(const FitRecord& fit) {
  Table table = record_table(fit.data);
  for (const FitInputRecord& input : fit.inputs) {
    if (input.datum < 1 || input.datum > std::ssize(table.rows)) continue;
    const auto found = std::find(table.columns.begin(), table.columns.end(), input.name);
    const auto column = static_cast<std::size_t>(found - table.columns.begin());
    if (found == table.columns.end()) {
      table.columns.push_back(input.name);
      for (auto& row : table.rows) row.emplace_back();
    }
    table.rows[static_cast<std::size_t>(input.datum - 1)][column] = cell_of(input.value);
  }
  return table;
}

Json number(double value) { return json_of(cell_of(value)); }

Json interval_json(double lowest, double highest, const std::string& low, const std::string& high) {
  const auto kind = [](const std::string& end) { return end.empty() ? Json(nullptr) : Json(end); };
  return {{"lowest", number(lowest)}, {"highest", number(highest)}, {"low", kind(low)}, {"high", kind(high)}};
}

Json fitted_json(const FitParameterRecord& p, const FitRecord& fit) {
  Json object = json_object("name", p.name, "unit", p.unit, "value", number(p.value), "standard_error",
                            number(p.standard_error), "relative_error", number(p.relative_error), "linear_interval",
                            interval_json(p.linear_lowest, p.linear_highest, p.linear_low, p.linear_high),
                            "profile_interval", nullptr, "start", number(p.start), "lowest", p.lowest, "highest",
                            p.highest, "scale", p.scale.empty() ? Json(nullptr) : Json(p.scale), "step", number(p.step),
                            "slope_doubt", number(p.slope_doubt), "flag", p.flag);
  if (p.profile_low.empty()) return object;
  object["profile_interval"] = interval_json(p.profile_lowest, p.profile_highest, p.profile_low, p.profile_high);
  object["profile"] = Json::array();
  for (const FitProfileRecord& point : fit.profiles)
    if (point.parameter == p.name)
      object["profile"].push_back({{"value", number(point.value)}, {"rise", number(point.rise)}});
  return object;
}

/// Adds what is fitted, the terms of the noise and what is fixed, each as a list of its own.
void add_parameters(Json& object, const FitRecord& fit) {
  for (const char* const list : {"parameters", "noise_terms", "fixed"}) object[list] = Json::array();
  for (const FitParameterRecord& p : fit.parameters) {
    if (p.noise)
      object["noise_terms"].push_back(
          {{"name", p.name},
           {"unit", p.unit},
           {"value", number(p.value)},
           {"standard_error", number(p.standard_error)},
           {"interval", interval_json(p.linear_lowest, p.linear_highest, p.linear_low, p.linear_high)}});
    else if (p.fixed)
      object["fixed"].push_back({{"name", p.name}, {"unit", p.unit}, {"value", number(p.value)}});
    else
      object["parameters"].push_back(fitted_json(p, fit));
  }
}

/// Each value with its inputs; without its deviation where none was given.
Json data_json(const FitRecord& fit) {
  Json data = json_of(data_of(fit));
  if (!fit.deviations_known)
    for (Json& one : data) one["deviation"] = nullptr;
  return data;
}

Json axis_json(const std::string& name, const std::string& unit, bool logarithmic) {
  return name.empty() ? Json(nullptr) : Json{{"name", name}, {"unit", unit}, {"logarithmic", logarithmic}};
}

/// "16: 3 scenes solved, 12 recalled, 1 repeated; 0 failed, in 0:02"; of a material, which needs no scenes, "101: 0
/// failed, in 0:02".
std::string evaluations_in_words(const FitRecord& fit) {
  std::string scenes;
  if (fit.solved > 0 || fit.recalled > 0) {
    const std::int64_t repeated = fit.evaluations - fit.solved - fit.recalled;
    if (fit.solved >= 0) scenes = std::to_string(fit.solved) + " scenes solved, ";
    scenes += std::to_string(fit.recalled) + " recalled";
    if (fit.solved >= 0 && repeated > 0) scenes += ", " + std::to_string(repeated) + " repeated";
    scenes += "; ";
  }
  return std::to_string(fit.evaluations) + ": " + scenes + std::to_string(fit.failures) + " failed, in " +
         duration_in_words(fit.seconds);
}

void write_correlations(std::ostream& text, const FitRecord& fit) {
  std::vector<std::pair<std::string, double>> pairs;
  for (const FitCorrelationRecord& pair : fit.correlations)
    if (std::abs(pair.correlation) > 0.1) pairs.emplace_back(pair.first + ", " + pair.second, pair.correlation);
  if (pairs.empty()) return;
  constexpr std::size_t most_shown = 12;
  text << "\ncorrelations above 0.1";
  if (pairs.size() > most_shown) {
    text << ", the " << most_shown << " strongest of " << pairs.size() << " (--json has all)";
    pairs.resize(most_shown);
  }
  text << '\n';
  std::size_t widest = 42;
  for (const auto& [names, correlation] : pairs) widest = std::max(widest, width(names));
  for (const auto& [names, correlation] : pairs)
    text << "  " << padded(names, widest + 2) << short_number(correlation, 4) << '\n';
}

}  // namespace

bool is_logarithmic(const FitParameterRecord& one) {
  if (!(one.linear_lowest > 0) || !(one.value > 0)) return false;
  const double up = std::log(one.linear_highest / one.value), down = std::log(one.value / one.linear_lowest);
  return std::abs(up - down) < 1e-3 * up;
}

Table fit_parameter_table(const FitRecord& fit) {
  Table table{{"parameter", "value", "+-", "relative", "95 % linear", "95 % profile", "start", "flag"}, {}};
  for (const FitParameterRecord& p : fit.parameters) {
    const bool linear = !std::isnan(p.linear_lowest) || !std::isnan(p.linear_highest);
    const ValueAndError shown = value_and_error(p.value, p.standard_error, p.unit);
    table.rows.push_back({p.name, shown.value, shown.error, percent(p.relative_error),
                          linear ? interval_in_words(p.linear_lowest, p.linear_highest, p.unit) : "-",
                          p.profile_low.empty() ? "-" : interval_in_words(p.profile_lowest, p.profile_highest, p.unit),
                          readable(p.start, p.unit), p.flag});
  }
  return table;
}

double scatter_of(const FitRecord& fit) {
  return fit.deviations_known || !(fit.reduced_chi_squared > 0) ? 1 : std::sqrt(fit.reduced_chi_squared);
}

std::vector<std::pair<std::string, std::string>> fit_statistics(const FitRecord& fit) {
  const bool noise = any_of(fit.parameters, [](const auto& p) { return p.noise; });
  std::vector<std::pair<std::string, std::string>> lines{
      {"kind", fit.kind},
      {"data", std::to_string(fit.data.size()) + " values, " + std::to_string(fit.degrees) +
                   " degrees of freedom, digest " + fit.data_digest.substr(0, 12)},
      {"deviations", fit.deviations_known ? "as given (absolute)"
                     : noise              ? "by the fitted noise"
                                          : "not given: errors are scaled by the reduced chi squared"},
      {"chi squared", four_digits(fit.chi_squared) + ", reduced " + four_digits(fit.reduced_chi_squared) +
                          (std::isnan(fit.p_value) ? "" : ", p = " + four_digits(fit.p_value))},
      {"rms", (fit.output_unit.empty() ? "" : readable(fit.rms, fit.output_unit) + ", ") + "relative " +
                  percent(fit.relative_rms)}};
  const auto worst =
      max_element(fit.data, [](const auto& a, const auto& b) { return std::abs(a.residual) < std::abs(b.residual); });
  if (worst != fit.data.end())
    lines.emplace_back("largest residual",
                       short_number(worst->residual / scatter_of(fit), 3) +
                           (fit.deviations_known ? " deviations" : " deviations, as the residuals scatter") +
                           (worst->place.empty() ? "" : " at " + worst->place));
  lines.insert(lines.end(),
               {{"runs test", "p = " + four_digits(fit.runs_p_value) + "; in the order of the predicted values " +
                                  four_digits(fit.trend_p_value)},
                {"condition", four_digits(fit.condition) +
                                  (fit.weakest_direction.empty() ? "" : "; weakest: " + fit.weakest_direction)},
                {"noise of the model", four_digits(fit.noise) + " (relative)"}});
  std::vector<std::string> steps;  // parameters whose slopes are known have none
  for (const FitParameterRecord& p : fit.parameters)
    if (std::isfinite(p.step)) steps.push_back(p.name + " " + four_digits(p.step));
  if (!steps.empty()) lines.emplace_back("steps (scaled)", joined(steps));
  lines.emplace_back(
      "descents", std::to_string(fit.agreeing) + " of " + std::to_string(fit.starts) + " starts agree" +
                      (fit.iterations < 0 ? "" : "; the best took " + std::to_string(fit.iterations) + " iterations"));
  lines.emplace_back("evaluations", evaluations_in_words(fit));
  return lines;
}

std::string fit_summary(const FitRecord& fit) {
  std::ostringstream text;
  text << fit.name << ": " << fit.status << '\n';
  if (!fit.reason.empty()) text << "reason   " << fit.reason << '\n';
  for (const std::string& warning : lines_of(fit.warnings)) text << "warning  " << warning << '\n';
  for (const std::string& note : lines_of(fit.model)) text << "model    " << note << '\n';
  for (const FitFailureRecord& failure : fit.failure_reasons)
    text << "failed   " << failure.count << " x " << failure.reason << " (first " << failure.first_place << ")\n";
  text << '\n';
  write_aligned(text, fit_parameter_table(fit));
  if (fit.data.empty()) return text.str();
  text << '\n';
  for (const auto& [name, words] : fit_statistics(fit)) text << "  " << padded(name, 20) << words << '\n';
  write_correlations(text, fit);
  return text.str();
}

Json json_of(const FitRecord& fit) {
  Json object;
  visit_columns(fit, [&](const char* name, const auto& value) { object[name] = json_of(column_cell(value)); });
  for (const char* const told_otherwise : {"name", "definition", "deviations_known", "output_unit", "x_name", "x_unit",
                                           "x_logarithmic", "y_name", "y_unit", "y_logarithmic"})
    object.erase(told_otherwise);
  object.update(json_object(
      "fit", fit.name, "warnings", lines_of(fit.warnings), "model", lines_of(fit.model), "values", fit.data.size(),
      "deviations", fit.deviations_known ? "absolute" : "scaled by the reduced chi squared", "interrupted",
      fit.interrupted, "failed", fit.failures, "failures", json_of(record_table(fit.failure_reasons)), "scene",
      fit.scene.empty() ? Json(nullptr) : Json::parse(fit.scene), "correlations",
      json_of(record_table(fit.correlations)), "data", data_json(fit), "x",
      axis_json(fit.x_name, fit.x_unit, fit.x_logarithmic), "y", axis_json(fit.y_name, fit.y_unit, fit.y_logarithmic),
      "curves", json_of(record_table(fit.curves))));
  add_parameters(object, fit);
  return object;
}

Table fit_table(const std::vector<FitSummary>& fits) {
  Table table{{"fit", "kind", "status", "parameters", "values", "chi squared", "created (UTC)"}, {}};
  for (const FitSummary& fit : fits)
    table.rows.push_back({fit.name, fit.kind, fit.status, few(fit.parameters), fit.values, cell_of(fit.chi_squared),
                          to_the_second(fit.created)});
  return table;
}

std::optional<FitRecord> meant_fit(ResultStore& store, std::string name, FitParts parts) {
  if (const auto fits = stored_fits(store.database()); name.empty() && fits.size() == 1 && store.study_names().empty())
    name = fits.front().name;
  if (name.empty() || store.definition(name)) return std::nullopt;
  return find_fit(store.database(), name, parts);
}

void refuse_fit(const Database& database, const std::string& name, const std::string& asked) {
  std::vector<std::string> known;
  for (const FitSummary& fit : stored_fits(database)) known.push_back(fit.name);
  throw std::invalid_argument(unknown(asked + name + ": no such fit", known, name));
}

std::vector<std::string> export_fit(const FitRecord& fit, const std::filesystem::path& folder) {
  make_directory(folder);
  std::vector<std::string> files{"fit.json", "report.json", "parameters.csv", "data.csv", "profiles.csv", "curves.csv"};
  write_file(folder / files[0], accepted_study(fit.definition) + "\n");
  write_file(folder / files[1], text_of(json_of(fit), 2) + "\n");
  write_file(folder / files[2], csv_of(record_table(fit.parameters)));
  write_file(folder / files[3], csv_of(data_of(fit)));
  write_file(folder / files[4], csv_of(record_table(fit.profiles)));
  write_file(folder / files[5], csv_of(record_table(fit.curves)));
  if (!fit.scene.empty()) write_file(folder / files.emplace_back("scene.json"), accepted_study(fit.scene) + "\n");
  return files;
}

}  // namespace rollres
