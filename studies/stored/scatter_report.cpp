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
  return value_in_words(quantity, cell, quantity.unit_for(report.indenter()));
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

/// An output at a place: the numbers of the points, or of a polynomial where all of them are surer.
struct ShownScatter {
  ScatterStatistics numbers;
  std::optional<SurrogateStatistics> tried = {};
  bool from_surrogate = false;

  ShownScatter(const ScatterReport& report, const ScatterBatches& values)
      : numbers(scatter_statistics(values, report.wish.probabilities)) {
    if (report.surrogate) tried = surrogate_statistics(*report.surrogate, values, report.wish.probabilities);
    from_surrogate = tried && is_surer(*tried, numbers);
    if (!from_surrogate) return;
    numbers.mean = tried->mean;
    numbers.deviation = tried->deviation;
    numbers.quantiles = tried->quantiles;
  }
};

struct ShownProbability {
  ScatterEstimate estimate;
  bool from_surrogate = false;

  ShownProbability(const ScatterReport& report, const ScatterPlace& place, std::size_t condition)
      : estimate(probability(place.holds[condition])) {
    if (!report.surrogate) return;
    const auto tried = surrogate_probability(*report.surrogate, place.excess[condition]);
    const bool rare = tried && (tried->value == 0 || tried->value == 1);  // beyond what the points tell
    from_surrogate = tried && !rare && tried->error < estimate.error;
    if (from_surrogate) estimate = *tried;
  }
};

/// "polynomial of degree 4, 23 terms, off by 1.2e-5 of the deviation"
std::string in_words(const SurrogateStatistics& surrogate) {
  return "polynomial of degree " + std::to_string(surrogate.degree) + ", " + std::to_string(surrogate.terms) +
         (surrogate.terms == 1 ? " term" : " terms") + ", off by " + percent(surrogate.error, 2) +
         " of the standard deviation";
}

void print_output(const ScatterReport& report, std::size_t output, std::ostream& out) {
  std::vector<ShownScatter> all;
  double largest = 0;
  for (const ScatterPlace& place : report.results.places) {
    all.emplace_back(report, place.values[output]);
    if (std::isfinite(all.back().numbers.mean.value))
      largest = std::max(largest, std::abs(all.back().numbers.mean.value));
  }
  const Formula& formula = report.wish.outputs[output];
  const ScaledUnit unit = scaled_unit(unit_of(formula, report.indenter()), largest);
  out << '\n' << formula.text() << (unit.name.empty() ? "" : " [" + typeset_unit(unit.name) + "]") << '\n';
  Table table = begun(report);
  for (const char* const name : {"mean", "standard deviation"}) table.columns.emplace_back(name);
  for (const double probability : report.wish.probabilities) table.columns.push_back(quantile_name(probability));
  if (report.surrogate) table.columns.emplace_back("from");
  for (std::size_t i = 0; i < all.size(); ++i) {
    const ScatterStatistics& numbers = all[i].numbers;
    table.rows[i].emplace_back(with_error(numbers.mean, unit.factor));
    table.rows[i].emplace_back(with_error(numbers.deviation, unit.factor));
    for (const ScatterEstimate& quantile : numbers.quantiles)
      table.rows[i].emplace_back(with_error(quantile, unit.factor));
    if (!report.surrogate) continue;
    table.rows[i].emplace_back(all[i].from_surrogate ? in_words(*all[i].tried)
                               : all[i].tried        ? "the points; a " + in_words(*all[i].tried) + " is no surer"
                                                     : "the points; no surrogate without all their answers");
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
      table.rows[i].emplace_back(with_error(ShownProbability(report, report.results.places[i], j).estimate, 0.01));
  }
  add_lost(table, report);
  write_aligned(out, table, "-", "  ");
}

Json json_of(const ScatterEstimate& estimate) {
  return {{"value", finite_or_null(estimate.value)}, {"error", finite_or_null(estimate.error)}};
}

Json output_json(const ScatterReport& report, const ScatterPlace& place, std::size_t output) {
  const Formula& formula = report.wish.outputs[output];
  const ShownScatter shown(report, place.values[output]);
  const ScatterStatistics& found = shown.numbers;
  Json object{{"output", formula.text()},    {"unit", unit_of(formula, report.indenter())},
              {"values", found.values},      {"without", found.without},
              {"mean", json_of(found.mean)}, {"standard_deviation", json_of(found.deviation)}};
  for (std::size_t i = 0; i < found.quantiles.size(); ++i)
    object[quantile_name(report.wish.probabilities[i])] = json_of(found.quantiles[i]);
  object["from"] = shown.from_surrogate ? "surrogate" : "points";
  if (shown.tried)
    object["surrogate"] = {
        {"degree", shown.tried->degree}, {"terms", shown.tried->terms}, {"error", finite_or_null(shown.tried->error)}};
  return object;
}

}  // namespace

std::optional<SurrogatePoints> surrogate_points(const Study& study, const ScatterResults& results) {
  const UncertainInputs& uncertain = study.uncertain;
  const bool wanted = uncertain.surrogate == SurrogateWish::on ||
                      (uncertain.surrogate == SurrogateWish::automatic && study.base.indenter == Indenter::sphere);
  const bool whole = std::all_of(results.places.begin(), results.places.end(),
                                 [&](const ScatterPlace& place) { return place.points == uncertain.points; });
  if (!wanted || !whole) return std::nullopt;
  constexpr std::size_t points = 1U << 15U;
  UncertainInputs many = uncertain;
  many.points = points;
  many.scramblings = SurrogatePoints().wanted_batches;
  many.method = SampleMethod::sobol;
  return SurrogatePoints{germs_of(uncertain, uncertain_points(uncertain)),
                         germs_of(many, uncertain_points(many)).points};
}

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
  for (const std::string& line : in_words(uncertain, report.indenter())) out << "  " << line << '\n';
  for (std::size_t i = 0; i < report.wish.outputs.size(); ++i) print_output(report, i, out);
  print_probabilities(report, out);
}

Json json_of(const ScatterReport& report) {
  const UncertainInputs& uncertain = report.study.uncertain;
  Json object{{"study", report.study.name},
              {"points", report.results.points()},
              {"failed", report.results.failed()},
              {"missing", report.results.missing()},
              {"method", name_of(uncertain.method)},
              {"scramblings", uncertain.scramblings},
              {"seed", uncertain.seed},
              {"uncertain", in_words(uncertain, report.indenter())},
              {"places", Json::array()}};
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
      const ShownProbability shown(report, place, i);
      Json one = json_of(shown.estimate);
      one["from"] = shown.from_surrogate ? "surrogate" : "points";
      one["condition"] = report.wish.conditions[i].text();
      here["probabilities"].push_back(one);
    }
  }
  return object;
}

}  // namespace rollres
