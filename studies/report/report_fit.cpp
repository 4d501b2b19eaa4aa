#include <cctype>
#include <cmath>

#include "studies/report/html.hpp"
#include "studies/report/report_sections.hpp"
#include "studies/stored_fits/fit_chart.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

using html::TableRow;

std::string number(double value) { return std::isfinite(value) ? short_number(value, 4) : "-"; }

std::string interval(double lowest, double highest, const std::string& unit) {
  if (std::isnan(lowest) && std::isnan(highest)) return "-";
  return (std::isnan(lowest) ? "open" : readable(lowest, unit)) + " to " +
         (std::isnan(highest) ? "open" : readable(highest, unit));
}

std::string parameter_table(const FitRecord& fit) {
  std::vector<TableRow> rows;
  for (const FitParameterRecord& p : fit.parameters)
    rows.push_back(
        {{in_words(p.name), readable(p.value, p.unit), p.fixed ? "fixed" : readable(p.standard_error, p.unit),
          p.fixed ? "" : percent(p.relative_error), p.fixed ? "" : interval(p.linear_lowest, p.linear_highest, p.unit),
          p.profile_low.empty() ? "-" : interval(p.profile_lowest, p.profile_highest, p.unit), p.flag},
         false});
  return html::table({{"parameter"},
                      {"value", true},
                      {"standard error", true},
                      {"relative", true},
                      {"95 % linear"},
                      {"95 % profile"},
                      {"flag"}},
                     rows);
}

std::string test_table(const FitRecord& fit) {
  const std::vector<TableRow> rows{
      {{"degrees of freedom", std::to_string(fit.degrees)}},
      {{"deviations", fit.deviations_known ? "as given" : "not given: errors are scaled by the reduced chi squared"}},
      {{"chi squared",
        number(fit.chi_squared) + ", reduced " + number(fit.reduced_chi_squared) + ", p = " + number(fit.p_value)}},
      {{"rms of the residuals", number(fit.rms)}},
      {{"runs test", "p = " + number(fit.runs_p_value)}},
      {{"condition",
        number(fit.condition) + (fit.weakest_direction.empty() ? "" : "; weakest: " + fit.weakest_direction)}},
      {{"noise of the model", number(fit.noise) + " (relative)"}},
      {{"descents", std::to_string(fit.agreeing) + " of " + std::to_string(fit.starts) + " starts agree"}},
      {{"evaluations", std::to_string(fit.evaluations) + ", " + std::to_string(fit.recalled) + " of them recalled, " +
                           std::to_string(fit.failures) + " failed, in " + readable(fit.seconds, "s")}}};
  return html::table({{"what"}, {"value"}}, rows);
}

/// "The fit of 24 measurements is usable: creep time = 251 ms (± 3.9 %), ... "
std::string fit_in_words(const FitRecord& fit) {
  std::string status;
  for (const char letter : in_words(fit.status))
    status += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  std::string text = "The fit of " + std::to_string(fit.data.size()) + " measurements is " + status;
  for (const FitParameterRecord& p : fit.parameters)
    text += (&p == &fit.parameters.front() ? ": " : ", ") + in_words(p.name) + " = " + readable(p.value, p.unit) +
            (p.fixed                           ? " (fixed)"
             : std::isfinite(p.relative_error) ? " (± " + percent(p.relative_error, 2) + ")"
                                               : "");
  text += ". ";
  if (fit.deviations_known && std::isfinite(fit.reduced_chi_squared))
    text += "It misses the measurements by " + short_number(std::sqrt(fit.reduced_chi_squared), 2) +
            " of their stated deviations on average; so large a misfit or a larger one comes by chance in " +
            percent(fit.p_value, 2) + " of all cases.";
  else if (std::isfinite(fit.rms))
    text += "It misses the measurements by " +
            (fit.y_unit.empty() ? short_number(fit.rms, 3) + " (SI, " : readable(fit.rms, fit.y_unit) + " (") +
            "root mean square).";
  return text;
}

}  // namespace

PictureSection fit_section(const FitRecord& fit) {
  std::string section = html::heading("Fit") + html::lead(fit_in_words(fit));
  for (const std::string* const words : {&fit.reason, &fit.warnings})
    if (!words->empty()) section += html::listing(*words);
  std::vector<std::pair<std::string, ChartRequest>> charts;
  for (FitChart& chart : fit_charts(fit)) charts.emplace_back(std::move(chart.meaning), std::move(chart.request));
  const PictureSection pictures = chart_pictures(charts);
  section += parameter_table(fit) + pictures.html + test_table(fit);
  std::vector<TableRow> pairs, data;
  for (const FitCorrelationRecord& pair : fit.correlations)
    pairs.push_back({{in_words(pair.first), in_words(pair.second), number(pair.correlation)}});
  if (!pairs.empty()) section += html::table({{"parameter"}, {"and"}, {"correlation", true}}, pairs);
  for (const FitDataRecord& one : fit.data)
    data.push_back({{std::filesystem::path(one.place).filename().string(), short_number(one.measured),
                     number(one.deviation), short_number(one.predicted), number(one.residual), number(one.band)},
                    std::abs(one.residual) > 3});
  const std::vector<html::TableColumn> columns{
      {"measurement"},    {"measured [SI]", true},      {"deviation [SI]", true},
      {"fit [SI]", true}, {"residual/deviation", true}, {"95 % band [SI]", true}};
  if (!data.empty())
    section += html::folded("Table of " + std::to_string(data.size()) + " measurements", html::table(columns, data));
  return {section, pictures.pictures};
}

}  // namespace rollres
