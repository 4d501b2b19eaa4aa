#include <cctype>
#include <cmath>

#include "studies/report/html.hpp"
#include "studies/report/report_sections.hpp"
#include "studies/stored_fits/fit_chart.hpp"
#include "studies/stored_fits/stored_fit.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

using html::TableRow;

std::string number(double value) { return std::isfinite(value) ? short_number(value, 4) : "-"; }

std::string parameter_table(const FitRecord& fit) {
  std::vector<TableRow> rows;
  for (const std::vector<Cell>& row : fit_parameter_table(fit).rows) {
    TableRow& texts = rows.emplace_back();
    for (const Cell& cell : row) texts.cells.push_back(std::get<std::string>(cell));
    texts.cells.front() = in_words(texts.cells.front());
  }
  return html::table({{"parameter"},
                      {"value", true},
                      {"standard error", true},
                      {"relative", true},
                      {"95 % linear"},
                      {"95 % profile"},
                      {"start", true},
                      {"flag"}},
                     rows);
}

std::string test_table(const FitRecord& fit) {
  std::vector<TableRow> rows;
  for (const auto& [name, words] : fit_statistics(fit)) rows.push_back({{name, words}});
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
            (p.fixed && !p.noise               ? " (fixed)"
             : std::isfinite(p.relative_error) ? " (± " + percent(p.relative_error, 2) + ")"
                                               : "");
  text += ". ";
  if (fit.deviations_known && std::isfinite(fit.reduced_chi_squared))
    text += "It misses the measurements by " + short_number(std::sqrt(fit.reduced_chi_squared), 2) +
            " of their stated deviations on average; so large a misfit or a larger one comes by chance in " +
            percent(fit.p_value, 2) + " of all cases.";
  else if (std::isfinite(fit.rms))
    text +=
        "It misses the measurements by " +
        (fit.output_unit.empty() ? short_number(fit.rms, 3) + " (SI, " : readable(fit.rms, fit.output_unit) + " (") +
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
