#include <algorithm>
#include <cmath>

#include "core/messages/number_list.hpp"
#include "core/scene/idle_inputs.hpp"
#include "studies/report/html.hpp"
#include "studies/report/report_sections.hpp"
#include "studies/scene_io/scene_inputs.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/similar_texts.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

using html::TableColumn;
using html::TableRow;

const QuantityColumn& output(const std::string& key) { return *find_quantity_column(key); }

bool at_default(const Cell& cell, const InputKind& kind) {
  if (kind.optional || kind.list) return std::holds_alternative<std::monostate>(cell);
  if (const auto* const text = std::get_if<std::string>(&kind.default_value)) return cell == Cell(*text);
  const auto* const number = std::get_if<double>(&kind.default_value);
  if (!number) return false;
  if (const auto* const count = std::get_if<std::int64_t>(&cell)) return static_cast<double>(*count) == *number;
  return cell == Cell(*number);
}

double quantile(const std::vector<double>& sorted, double share) {
  return sorted[static_cast<std::size_t>(std::lround(share * static_cast<double>(sorted.size() - 1)))];
}

/// A column of the table of results: one unit for all rows where they have one.
struct ResultColumn {
  const QuantityColumn* column;
  std::optional<ColumnScale> scale = {};

  ResultColumn(const ReportSource& source, const QuantityColumn& quantity) : column(&quantity) {
    if (quantity.type == "TEXT") return;
    const bool mixed = quantity.quantity.grows_with_width() && body_of_other_units(source.rows);
    if (!mixed) scale = scale_of(source.rows, quantity, AxisScale::automatic, false, "");
  }
  TableColumn head() const {
    const ChartAxis named = scale ? described(*column, *scale) : described(*column);
    std::string words = named.name + (column->name == "error_estimate" ? " of R_r" : "");
    if (!named.symbol.empty()) words += " " + named.symbol;
    if (scale && !scale->unit.name.empty()) words += " [" + typeset_unit(scale->unit.name) + "]";
    return {words, scale.has_value()};
  }
  std::string cell(const StudyRows& rows, std::size_t row) const {
    if (!scale) return shown_cell(rows, row, *column);
    const double value = rows.number(row, *column);
    if (std::isnan(value)) return "-";
    return std::isinf(value) ? "infinite" : short_number(scale->unit.number(value), shown_digits);
  }
};

/// From where to where some points lie along each axis.
std::string span_of_points(const ReportSource& source, const std::vector<std::size_t>& points) {
  return joined(source.varied(), ", ", [&](const QuantityColumn* axis) {
    const auto less = [&](std::size_t a, std::size_t b) {
      return source.rows.cell(a, *axis) < source.rows.cell(b, *axis);
    };
    const auto [least, greatest] = minmax_element(points, less);
    const std::string from = shown_cell(source.rows, *least, *axis), to = shown_cell(source.rows, *greatest, *axis);
    return in_words(axis->quantity.key) + " = " + (from == to ? from : from + " to " + to);
  });
}

/// A value; of a long list of numbers how many there are, from where to where: "49 values, 4.5 MPa to 394 MPa".
std::string told_in_short(const Quantity& quantity, const Cell& cell, std::string_view unit) {
  constexpr std::size_t few = 6;
  const auto* const text = std::get_if<std::string>(&cell);
  const auto list = text ? list_in(*text) : std::nullopt;
  if (!list || list->size() <= few) return value_in_words(quantity, cell, unit);
  const auto [least, greatest] = std::minmax_element(list->begin(), list->end());
  return std::to_string(list->size()) + " values, " + readable(quantity, *least, unit) + " to " +
         readable(quantity, *greatest, unit);
}

constexpr std::size_t most_open_rows = 24;  // more are folded

std::vector<ResultColumn> result_columns(const ReportSource& source) {
  constexpr std::size_t most = 9;
  std::vector<ResultColumn> columns;
  const auto add = [&](const QuantityColumn& column) {
    const bool there = any_of(columns, [&](const auto& c) { return c.column == &column; });
    if (!there && columns.size() < most) columns.emplace_back(source, column);
  };
  const auto add_named = [&](const std::string& key) {
    for (const QuantityColumn* const column : source.rows.columns())
      if (column->name == key) add(*column);
  };
  for (const QuantityColumn* const axis : source.varied()) add(*axis);
  for (const std::string& key : charted_numbers(source.definition, source.study.axes)) add_named(key);
  if (source.definition.compute.empty())
    for (const char* key : {"rolling_resistance", "rolling_resistance_coefficient", "approach", "peak_pressure"})
      add(output(key));
  for (const std::string& key : source.definition.compute) add_named(key);
  add(output("error_estimate"));
  return columns;
}

/// Some scenes of the study, evenly from all.
std::vector<RollingScene> some_scenes(const ReportSource& source) {
  constexpr std::size_t most = 32;
  const std::vector<std::string> keys = source.store.points(source.study.name);
  std::vector<RollingScene> scenes;
  for (std::size_t i = 0; i < keys.size(); i += 1 + keys.size() / most)
    if (const auto answer = source.store.find(keys[i])) scenes.push_back(answer->scene);
  return scenes;
}

}  // namespace

std::vector<double> sorted_values(const StudyRows& rows, const char* key) {
  std::vector<double> values;
  for (std::size_t row = 0; row < rows.size(); ++row)
    if (const double value = rows.number(row, key); rows.converged(row) && std::isfinite(value))
      values.push_back(value);
  std::sort(values.begin(), values.end());
  return values;
}

std::string shown_cell(const StudyRows& rows, std::size_t row, const QuantityColumn& column) {
  return told_in_short(column.quantity, rows.cell(row, column), column.quantity.unit_for(body_at(rows, row)));
}

std::string place_of(const ReportSource& source, std::size_t row) {
  return joined(source.varied(), ", ", [&](const QuantityColumn* axis) {
    return in_words(axis->quantity.key) + " = " + shown_cell(source.rows, row, *axis);
  });
}

std::vector<const QuantityColumn*> ReportSource::varied() const {
  std::vector<const QuantityColumn*> axes;
  for (const std::string& key : study.axes)
    if (const QuantityColumn& column = column_of(key, study, rows, "axis"); rows.values(column).size() > 1)
      axes.push_back(&column);
  return axes;
}

std::string scene_section(const ReportSource& source) {
  std::string section;
  std::vector<TableRow> axes, inputs;
  std::string defaults;
  const auto varied = source.varied();
  const std::vector<RollingScene> scenes = some_scenes(source);
  for (const QuantityColumn* const each : source.rows.columns()) {
    const QuantityColumn& column = *each;
    if (!column.is_input) continue;
    const Quantity& q = column.quantity;
    const std::string key = in_words(q.key), symbol(symbol_beside_name(q)), meaning(q.meaning);
    const std::vector<Cell> values = source.rows.values(column);
    const auto shown = [&](const Cell& cell) { return told_in_short(q, cell, q.unit_for(body_at(source.rows, 0))); };
    if (values.size() > 1) {
      constexpr std::size_t few = 8;
      const std::string list = values.size() <= few ? joined(values, ", ", shown)
                                                    : shown(*values.begin()) + " to " + shown(*values.rbegin());
      const bool axis = contains(varied, &column);
      axes.push_back({{key, symbol, list, std::to_string(values.size()), axis ? meaning : meaning + " (follows)"}});
      continue;
    }
    const Cell& value = *values.begin();
    const InputKind* const kind = find_input(q.key);
    if (std::holds_alternative<std::monostate>(value)) continue;
    if (kind && at_default(value, *kind) &&
        all_of(scenes, [&](const RollingScene& scene) { return is_idle(scene, q.key); }))
      continue;
    if (kind && at_default(value, *kind) && !q.symbol.empty() && q.unit != "1")
      inputs.push_back({{key, symbol, shown(value), meaning}});
    else if (kind && at_default(value, *kind))
      defaults += (defaults.empty() ? "" : ", ") + key + " = " + in_words(shown(value));
    else
      inputs.push_back({{key, symbol, shown(value), meaning}});
  }
  if (!axes.empty()) section += html::table({{"varied"}, {"symbol"}, {"values"}, {"number", true}, {"meaning"}}, axes);
  if (!inputs.empty()) section += html::table({{"the same in all points"}, {"symbol"}, {"value"}, {"meaning"}}, inputs);
  if (!defaults.empty()) section += html::paragraph("At their defaults: " + defaults + ".");
  return section;
}

std::string result_section(const ReportSource& source, std::size_t most_rows) {
  const std::vector<ResultColumn> columns = result_columns(source);
  const std::size_t points = source.rows.size(), step = std::max<std::size_t>(1, (points + most_rows - 1) / most_rows);
  std::vector<TableColumn> heads;
  for (const ResultColumn& column : columns) heads.push_back(column.head());
  heads.push_back({"status"});
  std::vector<TableRow> rows;
  for (std::size_t row = 0; row < points; row += step) {
    TableRow line{{}, !source.rows.converged(row)};
    for (const ResultColumn& column : columns) line.cells.push_back(column.cell(source.rows, row));
    line.cells.push_back(in_words(source.rows.text(row, "status")));
    rows.push_back(std::move(line));
  }
  std::string section = html::heading("Results"), note;
  if (step > 1)
    note = html::paragraph("Shown is one of every " + std::to_string(step) + " points, of " + std::to_string(points) +
                           ".");
  section += html::paragraph("All columns of all points: rollres query --db " + shell_word(source.file()) + " " +
                             shell_word("study=" + source.study.name) + " --format csv");
  const std::string table = note + html::table(heads, rows);
  if (rows.size() <= most_open_rows) return section + table;
  return section + html::folded("Table of " + std::to_string(rows.size()) + " points", table);
}

std::string failure_section(const ReportSource& source) {
  constexpr std::size_t most = 200;
  std::vector<std::string> reasons;
  std::vector<std::size_t> failed;
  std::vector<TableRow> places;
  for (std::size_t row = 0; row < source.rows.size(); ++row) {
    if (source.rows.converged(row)) continue;
    const std::string status = in_words(source.rows.text(row, "status")), reason = source.rows.text(row, "reason");
    reasons.push_back(status + (reason.empty() ? "" : ": ") + reason);
    failed.push_back(row);
    if (places.size() < most) places.push_back({{place_of(source, row), status, reason}});
  }
  std::string section = html::heading("Failures");
  if (reasons.empty()) return section + html::paragraph("None: every computed point converged.");
  std::map<std::string, std::vector<std::size_t>> kinds;
  const std::vector<std::string> kind = with_ranges(reasons);
  for (std::size_t i = 0; i < failed.size(); ++i) kinds[kind[i]].push_back(failed[i]);
  std::vector<TableRow> rows;
  for (const auto& [words, points] : kinds)
    rows.push_back({{words, std::to_string(points.size()), span_of_points(source, points)}});
  stable_sort(rows, [](const auto& a, const auto& b) { return std::stoul(a.cells[1]) > std::stoul(b.cells[1]); });
  section += html::table({{"reason"}, {"points", true}, {"where"}}, rows);
  std::string all = html::table({{"point"}, {"status"}, {"reason"}}, places);
  if (reasons.size() > most)
    all += html::paragraph(std::to_string(reasons.size() - most) + " further points are not listed.");
  return section + html::folded("The points without an answer, one by one", all);
}

std::string accuracy_section(const ReportSource& source) {
  std::string section = html::heading("Speed and accuracy");
  const auto line = [](const char* what, const std::vector<double>& sorted, double total, std::string_view unit) {
    std::vector<std::string> cells{what};
    for (const double share : {0.0, 0.5, 0.9, 1.0}) cells.push_back(readable(quantile(sorted, share), unit));
    cells.push_back(std::isnan(total) ? "" : readable(total, unit));
    return TableRow{cells};
  };
  std::vector<TableRow> rows;
  const std::vector<double> seconds = sorted_values(source.rows, "seconds");
  double total = 0;
  for (const double one : seconds) total += one;
  if (!seconds.empty()) rows.push_back(line("time of a solution", seconds, total, "s"));
  const std::pair<const char*, const char*> measures[] = {{"error_estimate", "estimated relative error of R_r"},
                                                          {"model_error", "what the model's assumptions cost of R_r"},
                                                          {"energy_residual", "what the power balance misses"},
                                                          {"law_violation", "violation of the laws of contact"}};
  for (const auto& [key, words] : measures)
    if (const std::vector<double> values = sorted_values(source.rows, key); !values.empty())
      rows.push_back(line(words, values, RollingSolution::absent, ""));
  if (rows.empty()) return section + html::paragraph("Nothing was measured.");
  section += html::table({{"over converged points"},
                          {"least", true},
                          {"median", true},
                          {"90 % below", true},
                          {"greatest", true},
                          {"together", true}},
                         rows);

  std::map<int, std::size_t> decades;
  for (const double error : sorted_values(source.rows, "error_estimate"))
    ++decades[error > 0 ? std::max(-16, static_cast<int>(std::ceil(std::log10(error) - 1e-9))) : -16];
  std::vector<TableRow> distribution;
  for (const auto& [decade, count] : decades)
    distribution.push_back({{"up to " + short_number(std::pow(10.0, decade), 3), std::to_string(count)}});
  if (!distribution.empty()) section += html::table({{"estimated error"}, {"points", true}}, distribution);
  return section;
}

std::string provenance_section(const ReportSource& source) {
  std::vector<TableRow> rows;
  for (const ComputedShare& share : computed_shares(source.store, source.study.name))
    rows.push_back(
        {{share.program.version + " (" + share.program.git_hash.substr(0, 12) + ")", share.program.solver.substr(0, 12),
          share.program.compiler, share.program.machine, std::to_string(share.points), readable(share.seconds, "s"),
          to_the_second(share.first) + " to " + to_the_second(share.last)}});
  const Provenance& here = this_program();
  const bool optimisation = is_optimisation(source.definition_text, source.file() + ": " + source.study.name);
  const StudySummary& study = source.study;
  std::string again =
      html::paragraph(std::to_string(study.points) + " points: " + std::to_string(study.answered - study.failed) +
                      " converged, " + std::to_string(study.failed) + " without an answer, " +
                      std::to_string(study.points - study.answered) + " not computed yet. First started " +
                      to_the_second(study.created) + " UTC, last result " + to_the_second(study.last_result) + " UTC.");
  again += source.definition_text.empty()
               ? html::paragraph("The study file was not stored.")
               : html::paragraph("This command computes what is missing, from the study file below:") +
                     html::listing(std::string("rollres ") + (optimisation ? "optimise" : "sweep") +
                                   " study.json --db " + shell_word(source.file()));
  return html::heading("Provenance") + again +
         html::table({{"rollres"},
                      {"solver"},
                      {"compiler"},
                      {"machine"},
                      {"points", true},
                      {"solutions took", true},
                      {"stored (UTC)"}},
                     rows) +
         html::paragraph("Database " + source.file() + ". This report was written by rollres " + here.version + " (" +
                         here.git_hash.substr(0, 12) + ").");
}

}  // namespace rollres
