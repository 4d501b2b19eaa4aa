#include "studies/stored/scatter_report.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>

#include "core/messages/message_text.hpp"
#include "studies/scene_io/scene_inputs.hpp"
#include "studies/stored/study_rows.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/table_json.hpp"
#include "studies/text/table_output.hpp"

namespace rollres {

namespace {

/// A number with so many digits behind its point, or whole where there would be none.
std::string fixed(double value, int decimals) {
  const double unit = std::pow(10.0, -decimals);
  if (decimals <= 0) return short_number(std::round(value / unit) * unit, 15);
  std::string text = short_number(std::round(value * std::pow(10.0, decimals)) / std::pow(10.0, decimals), 15);
  if (text.find('e') != std::string::npos) return text;
  const std::size_t point = text.find('.');
  if (point == std::string::npos) text += '.';
  const std::size_t behind = text.size() - text.find('.') - 1, wanted = static_cast<std::size_t>(decimals);
  return text + std::string(wanted - std::min(behind, wanted), '0');
}

std::string in_words(const ScatterReport& report, std::size_t axis, const Cell& cell) {
  if (const auto* const name = std::get_if<std::string>(&cell)) return *name;
  const Quantity& quantity = find_input(report.results.axes[axis])->quantity;
  return value_in_words(quantity, cell, quantity.unit_for(report.body()));
}

/// The columns of the axes, and of points without an answer where there are any.
Table begun(const ScatterReport& report) {
  Table table{report.results.axes, {}};
  for (const ScatterPlace& place : report.results.places) {
    std::vector<Cell>& row = table.rows.emplace_back();
    for (std::size_t i = 0; i < place.at.size(); ++i) row.emplace_back(in_words(report, i, place.at[i]));
  }
  return table;
}

void add_lost(Table& table, const ScatterReport& report) {
  if (report.results.failed() + report.results.missing() == 0) return;
  table.columns.emplace_back("without");
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const ScatterPlace& place = report.results.places[i];
    table.rows[i].emplace_back(static_cast<std::int64_t>(place.failed + place.missing));
  }
}

void print_output(const ScatterReport& report, std::size_t output, std::ostream& out) {
  std::vector<ScatterStatistics> all;
  double largest = 0;
  for (const ScatterPlace& place : report.results.places) {
    all.push_back(scatter_statistics(place.values[output], report.wish.probabilities));
    if (std::isfinite(all.back().mean.value)) largest = std::max(largest, std::abs(all.back().mean.value));
  }
  const Formula& formula = report.wish.outputs[output];
  const ScaledUnit unit = scaled_unit(unit_of(formula, report.body()), largest);
  out << '\n' << formula.text() << (unit.name.empty() ? "" : " [" + typeset_unit(unit.name) + "]") << '\n';
  Table table = begun(report);
  for (const char* const name : {"mean", "standard deviation"}) table.columns.emplace_back(name);
  for (const double probability : report.wish.probabilities) table.columns.push_back(quantile_name(probability));
  for (std::size_t i = 0; i < all.size(); ++i) {
    table.rows[i].emplace_back(with_error(all[i].mean, unit.factor));
    table.rows[i].emplace_back(with_error(all[i].deviation, unit.factor));
    for (const ScatterEstimate& quantile : all[i].quantiles)
      table.rows[i].emplace_back(with_error(quantile, unit.factor));
  }
  add_lost(table, report);
  write_aligned(out, table, "-", "  ");
}

void print_probabilities(const ScatterReport& report, std::ostream& out) {
  if (report.wish.conditions.empty()) return;
  out << "\nprobability [%]\n";
  Table table = begun(report);
  for (std::size_t j = 0; j < report.wish.conditions.size(); ++j) {
    table.columns.push_back(report.wish.conditions[j].text());
    for (std::size_t i = 0; i < table.rows.size(); ++i)
      table.rows[i].emplace_back(with_error(probability(report.results.places[i].holds[j]), 0.01));
  }
  add_lost(table, report);
  write_aligned(out, table, "-", "  ");
}

Json json_of(const ScatterEstimate& estimate) {
  return {{"value", finite_or_null(estimate.value)}, {"error", finite_or_null(estimate.error)}};
}

Json output_json(const ScatterReport& report, const ScatterPlace& place, std::size_t output) {
  const Formula& formula = report.wish.outputs[output];
  const ScatterStatistics found = scatter_statistics(place.values[output], report.wish.probabilities);
  Json object =
      json_object("output", formula.text(), "unit", unit_of(formula, report.body()), "values", found.values, "without",
                  found.without, "mean", json_of(found.mean), "standard_deviation", json_of(found.deviation));
  for (std::size_t i = 0; i < found.quantiles.size(); ++i)
    object[quantile_name(report.wish.probabilities[i])] = json_of(found.quantiles[i]);
  return object;
}

}  // namespace

std::string quantile_name(double probability) { return "P" + short_number(100 * probability, 6); }

std::string with_error(const ScatterEstimate& estimate, double factor) {
  const double value = estimate.value / factor, error = estimate.error / factor;
  if (!std::isfinite(value)) return "-";
  if (!std::isfinite(error)) return short_number(value, 5);
  if (error == 0) return short_number(value, 6) + " ± 0";
  const int decimals = 1 - static_cast<int>(std::floor(std::log10(error)));
  return fixed(value, decimals) + " ± " + fixed(error, decimals);
}

std::string place_in_words(const ScatterReport& report, const ScatterPlace& place) {
  std::string text;
  for (std::size_t i = 0; i < place.at.size(); ++i) {
    const InputKind* const input = find_input(report.results.axes[i]);  // none: the variants
    const std::string_view symbol = input ? input->quantity.symbol : "";
    text += i == 0 ? "" : ", ";
    if (!symbol.empty()) text += std::string(symbol) + " = ";
    text += in_words(report, i, place.at[i]);
  }
  return text;
}

void print_text(const ScatterReport& report, std::ostream& out) {
  const UncertainInputs& uncertain = report.study.uncertain;
  out << report.study.name << ": " << uncertain.scramblings << " x " << uncertain.points_of_each() << " points ("
      << name_of(uncertain.method) << ", seed " << uncertain.seed << ')'
      << (report.results.axes.empty() ? "" : " at each of " + std::to_string(report.results.places.size()) + " places")
      << '\n';
  for (const std::string& line : in_words(uncertain, report.body())) out << "  " << line << '\n';
  for (std::size_t i = 0; i < report.wish.outputs.size(); ++i) print_output(report, i, out);
  print_probabilities(report, out);
}

Json json_of(const ScatterReport& report) {
  const UncertainInputs& uncertain = report.study.uncertain;
  Json object = json_object("study", report.study.name, "points", report.results.points(), "failed",
                            report.results.failed(), "missing", report.results.missing(), "method",
                            name_of(uncertain.method), "scramblings", uncertain.scramblings, "seed", uncertain.seed,
                            "uncertain", in_words(uncertain, report.body()), "places", Json::array());
  for (const ScatterPlace& place : report.results.places) {
    Json& here = object["places"].emplace_back(Json::object());
    for (std::size_t i = 0; i < place.at.size(); ++i) here[report.results.axes[i]] = json_of(place.at[i]);
    here["points"] = place.points;
    here["failed"] = place.failed;
    here["missing"] = place.missing;
    here["outputs"] = Json::array();
    for (std::size_t i = 0; i < report.wish.outputs.size(); ++i)
      here["outputs"].push_back(output_json(report, place, i));
    here["probabilities"] = Json::array();
    for (std::size_t i = 0; i < report.wish.conditions.size(); ++i) {
      Json one = json_of(probability(place.holds[i]));
      one["condition"] = report.wish.conditions[i].text();
      here["probabilities"].push_back(one);
    }
  }
  return object;
}

}  // namespace rollres
