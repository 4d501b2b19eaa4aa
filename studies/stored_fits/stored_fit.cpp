#include "studies/stored_fits/stored_fit.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "studies/text/files.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/table_json.hpp"
#include "studies/text/table_output.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

std::string interval(double lowest, double highest, const std::string& unit) {
  if (std::isnan(lowest) && std::isnan(highest)) return "-";
  const auto end = [&](double value) { return std::isnan(value) ? std::string("open") : readable(value, unit); };
  return end(lowest) + " .. " + end(highest);
}

Cell cell(double value) { return std::isnan(value) ? Cell() : Cell(value); }

/// A list of names, cut off where it is long.
std::string few(const std::string& names) {
  constexpr std::size_t longest = 60;
  if (names.size() <= longest) return names;
  const std::vector<std::string> all = split_at_commas(names);
  return all.front() + ", " + all[1] + " and " + std::to_string(all.size() - 2) + " others";
}

/// All of the parameters, for other programs.
Table parameters_of(const FitRecord& fit) {
  Table table{{"name", "unit", "fixed", "value", "standard_error", "relative_error", "linear_lowest", "linear_highest",
               "profile_lowest", "profile_highest", "start", "flag"},
              {}};
  for (const FitParameterRecord& p : fit.parameters)
    table.rows.push_back({p.name, p.unit, std::int64_t{p.fixed}, cell(p.value), cell(p.standard_error),
                          cell(p.relative_error), cell(p.linear_lowest), cell(p.linear_highest), cell(p.profile_lowest),
                          cell(p.profile_highest), cell(p.start), p.flag});
  return table;
}

/// With a column for each input, in SI.
Table data_of(const FitRecord& fit) {
  Table table{{"place", "curve", "x", "measured", "deviation", "predicted", "residual", "band"}, {}};
  for (const FitDataRecord& one : fit.data)
    table.rows.push_back({one.place, one.curve < 0 ? Cell() : Cell(one.curve), cell(one.x), cell(one.measured),
                          cell(one.deviation), cell(one.predicted), cell(one.residual), cell(one.band)});
  for (const FitInputRecord& input : fit.inputs) {
    if (input.datum < 1 || input.datum > std::ssize(table.rows)) continue;
    const auto found = std::find(table.columns.begin(), table.columns.end(), input.name);
    const auto column = static_cast<std::size_t>(found - table.columns.begin());
    if (found == table.columns.end()) {
      table.columns.push_back(input.name);
      for (auto& row : table.rows) row.emplace_back();
    }
    table.rows[static_cast<std::size_t>(input.datum - 1)][column] = cell(input.value);
  }
  return table;
}

Table profiles_of(const FitRecord& fit) {
  Table table{{"parameter", "value", "rise"}, {}};
  for (const FitProfileRecord& one : fit.profiles)
    table.rows.push_back({one.parameter, cell(one.value), cell(one.rise)});
  return table;
}

Table curves_of(const FitRecord& fit) {
  Table table{{"curve", "label", "x", "value", "band"}, {}};
  for (const FitCurveRecord& one : fit.curves)
    table.rows.push_back({one.curve, one.label, cell(one.x), cell(one.value), cell(one.band)});
  return table;
}

Json axis_json(const std::string& name, const std::string& unit, bool logarithmic) {
  return {{"name", name}, {"unit", unit}, {"logarithmic", logarithmic}};
}

}  // namespace

bool is_logarithmic(const FitParameterRecord& one) {
  if (!(one.linear_lowest > 0) || !(one.value > 0)) return false;
  const double up = std::log(one.linear_highest / one.value), down = std::log(one.value / one.linear_lowest);
  return std::abs(up - down) < 1e-3 * up;
}

std::string fit_record_summary(const FitRecord& fit) {
  std::ostringstream text;
  text << fit.name << ": " << fit.status << " (a fit of kind " << fit.kind << ")\n";
  if (!fit.reason.empty()) text << "reason   " << fit.reason << '\n';
  std::istringstream warnings(fit.warnings);
  for (std::string warning; std::getline(warnings, warning);) text << "warning  " << warning << '\n';
  text << '\n';
  Table table{{"parameter", "value", "+-", "relative", "95 % linear", "95 % profile", "flag"}, {}};
  for (const FitParameterRecord& p : fit.parameters)
    table.rows.push_back(
        {p.name, readable(p.value, p.unit), p.fixed ? std::string("-") : readable(p.standard_error, p.unit),
         p.fixed ? std::string("-") : percent(p.relative_error), interval(p.linear_lowest, p.linear_highest, p.unit),
         p.profile_low.empty() ? "-" : interval(p.profile_lowest, p.profile_highest, p.unit), p.flag});
  write_aligned(text, table);
  const auto number = [](double value) { return std::isfinite(value) ? short_number(value, 4) : std::string("-"); };
  text << "\n  data         " << fit.data.size() << " values, " << fit.degrees << " degrees of freedom, digest "
       << fit.data_digest.substr(0, 12) << "\n  chi squared  " << number(fit.chi_squared) << ", reduced "
       << number(fit.reduced_chi_squared) << (std::isnan(fit.p_value) ? "" : ", p = " + number(fit.p_value))
       << "\n  evaluations  " << fit.evaluations << " in " << readable(fit.seconds, "s") << '\n';
  return text.str();
}

Json json_of(const FitRecord& fit) {
  return {{"fit", fit.name},
          {"kind", fit.kind},
          {"status", fit.status},
          {"reason", fit.reason},
          {"warnings", fit.warnings},
          {"data_digest", fit.data_digest},
          {"degrees", fit.degrees},
          {"chi_squared", finite_or_null(fit.chi_squared)},
          {"reduced_chi_squared", finite_or_null(fit.reduced_chi_squared)},
          {"p_value", finite_or_null(fit.p_value)},
          {"rms", finite_or_null(fit.rms)},
          {"runs_p_value", finite_or_null(fit.runs_p_value)},
          {"weakest_direction", fit.weakest_direction},
          {"evaluations", fit.evaluations},
          {"seconds", finite_or_null(fit.seconds)},
          {"scene", fit.scene.empty() ? Json(nullptr) : Json::parse(fit.scene)},
          {"parameters", json_of(parameters_of(fit))},
          {"data", json_of(data_of(fit))},
          {"profile_threshold", finite_or_null(fit.profile_threshold)},
          {"profiles", json_of(profiles_of(fit))},
          {"x", fit.x_name.empty() ? Json(nullptr) : axis_json(fit.x_name, fit.x_unit, fit.x_logarithmic)},
          {"y", fit.x_name.empty() ? Json(nullptr) : axis_json(fit.y_name, fit.y_unit, fit.y_logarithmic)},
          {"curves", json_of(curves_of(fit))}};
}

Table fit_table(const std::vector<FitSummary>& fits) {
  Table table{{"fit", "kind", "status", "parameters", "values", "chi squared", "created (UTC)"}, {}};
  for (const FitSummary& fit : fits)
    table.rows.push_back({fit.name, fit.kind, fit.status, few(fit.parameters), fit.values, cell(fit.chi_squared),
                          fit.created.substr(0, 10) + " " + fit.created.substr(11, 8)});
  return table;
}

std::vector<std::string> export_fit(const FitRecord& fit, const std::filesystem::path& folder) {
  make_directory(folder);
  std::vector<std::string> files{"fit.json", "report.json", "parameters.csv", "data.csv", "profiles.csv", "curves.csv"};
  write_file(folder / files[0], fit.definition + "\n");
  write_file(folder / files[1], text_of(json_of(fit), 2) + "\n");
  write_file(folder / files[2], csv_of(parameters_of(fit)));
  write_file(folder / files[3], csv_of(data_of(fit)));
  write_file(folder / files[4], csv_of(profiles_of(fit)));
  write_file(folder / files[5], csv_of(curves_of(fit)));
  if (!fit.scene.empty()) write_file(folder / files.emplace_back("scene.json"), fit.scene + "\n");
  return files;
}

}  // namespace rollres
