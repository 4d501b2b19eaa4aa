#include "studies/stored/shown_table.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

#include "core/scene/scene_input.hpp"
#include "studies/scene_io/dimension.hpp"
#include "studies/scene_io/scene_inputs.hpp"
#include "studies/stored/derived_columns.hpp"
#include "studies/stored/study_rows.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/table_output.hpp"

namespace rollres {

namespace {

/// A goal's column is known by the formula of its study.
const QuantityColumn* quantity_in(const std::string& name, const FormulaDefinitions& formulas) {
  for (const auto& [key, formula] : formulas)
    if (key == name) return &derived_column(name, formula);
  const QuantityColumn* const column = find_quantity_column(name);
  return column && column->type == "REAL" ? column : nullptr;
}

/// The unit of all rows; nothing where it differs.
std::optional<std::string_view> common_unit(const QuantityColumn& column, const ShownColumns& columns) {
  if (!column.quantity.grows_with_width()) return column.quantity.unit;
  if (columns.bodies.empty() || !columns.bodies.front()) return std::nullopt;
  for (const auto& body : columns.bodies)
    if (!body || body->per_metre() != columns.bodies.front()->per_metre()) return std::nullopt;
  return column.quantity.unit_for(*columns.bodies.front());
}

std::vector<double> numbers_in(const Table& table, std::size_t column) {
  std::vector<double> numbers;
  for (const auto& row : table.rows)
    if (const auto* const number = std::get_if<double>(&row[column])) numbers.push_back(*number);
  return numbers;
}

/// Each cell with its own unit, where its body is known.
void show_one_by_one(Table& table, std::size_t column, const QuantityColumn& quantity, const ShownColumns& columns) {
  bool known = true;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    auto* const number = std::get_if<double>(&table.rows[row][column]);
    if (!number) continue;
    const auto& body = columns.bodies.size() == 1 ? columns.bodies.front() : columns.bodies[row];
    known = known && body;
    table.rows[row][column] =
        body ? Cell(readable(quantity.quantity, *number, quantity.quantity.unit_for(*body))) : Cell(to_digits(*number));
  }
  if (!known)
    table.columns[column] +=
        " [" + std::string(quantity.quantity.unit_2d) + " or " + std::string(quantity.quantity.unit) + "]";
}

std::string sorted_by(const std::string& text) { return text.substr(text.starts_with('-') ? 1 : 0); }

/// Columns of groups: those of `by`, then the aggregates.
struct GroupColumns {
  std::vector<QuantityColumn> kept;  // what aggregates are of
  std::deque<std::string> units;     // of weighted sums
  ShownColumns shown;

  GroupColumns(const GroupQuery& query, const FormulaDefinitions& formulas) {
    kept.reserve(query.aggregates.size());
    for (const std::string& name : query.by) shown.quantities.push_back(quantity_in(name, formulas));
    for (const Aggregate& aggregate : query.aggregates) {
      const QuantityColumn* const of = quantity_in(aggregate.column, formulas);
      const bool counts = aggregate.statistic == Statistic::count;
      const bool weighted_sum = aggregate.statistic == Statistic::sum && !aggregate.weight.empty();
      const QuantityColumn* const weight = weighted_sum ? quantity_in(aggregate.weight, formulas) : nullptr;
      shown.quantities.push_back(nullptr);
      if (!of || counts || (weighted_sum && !weight)) continue;
      kept.push_back(*of);
      if (weight) multiply(kept.back().quantity, weight->quantity);
      if (aggregate.statistic == Statistic::stddev || aggregate.statistic == Statistic::sum)
        kept.back().quantity.key = "difference";  // of temperatures: no scale with an origin
      shown.quantities.back() = &kept.back();
    }
  }

 private:
  /// Gives a quantity the unit of its product with a weight.
  void multiply(Quantity& of, const Quantity& weight) {
    const auto product = [&](Body body) -> std::string_view {
      return units.emplace_back(product_of_units(of.unit_for(body), weight.unit_for(body)));
    };
    const bool grows = of.grows_with_width() || weight.grows_with_width();
    const std::string_view line = grows ? product(Indenter::cylinder) : std::string_view();
    of.unit = product(Indenter::sphere);
    of.unit_2d = line;
  }
};

bool differs_by_body(const ShownColumns& columns) {
  return any_of(columns.quantities, [](const QuantityColumn* one) { return one && one->quantity.grows_with_width(); });
}

/// Columns that may be shown by themselves: inputs by the key under which answers have them, too.
std::vector<std::pair<std::string, std::string>> candidates(const Database& database, bool of_study) {
  std::vector<std::pair<std::string, std::string>> names;  // what to compare, what to show
  const std::set<std::string> present = column_names(database.connection(), of_study ? "result" : "evaluation");
  if (of_study)
    for (const char* const name : {"study", "variant"}) names.emplace_back(name, name);
  for (const InputKind& kind : input_kinds()) {
    if (kind.list && !kind.layers) continue;  // too long to be read
    const std::string key(kind.quantity.key);
    names.emplace_back(input_column(key), key == "method" || key == "spacing" ? input_column(key) : key);
  }
  if (of_study)
    for (const char* const name : {"front", "goal", "second_goal", "feasible"}) names.emplace_back(name, name);
  std::erase_if(names, [&](const auto& one) { return !present.contains(one.first); });
  return names;
}

/// Inputs of further layers that differ.
std::vector<std::string> varied_in_layers(const Database& database, Query query, std::string_view list) {
  query.columns.clear();
  for (const QuantityColumn* const column : quantity_columns_of(database, query.filters))
    if (const auto key = layer_key(column->name); key && key->list == list) query.columns.push_back(column->name);
  if (query.columns.empty()) return {};
  const std::vector<bool> varies = columns_that_vary(database, query);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < varies.size(); ++i)
    if (varies[i]) names.push_back(query.columns[i]);
  return names;
}

/// What all rows of a question have as indenter; nothing where they differ.
Cell common_indenter(const Database& database, const GroupQuery& query) {
  if (contains(query.by, "indenter")) return {};  // each group has its own
  // Where all of a database are of one kind, an index tells, whatever the filters.
  Table found = run_group_query(database, {.by = {"indenter"}});
  if (found.rows.size() != 1)
    found = run_group_query(database, {.filters = query.filters, .by = {"indenter"}, .computed = query.computed});
  return found.rows.size() == 1 ? found.rows.front().front() : Cell();
}

}  // namespace

std::optional<Body> body_in(const Cell& indenter, const Cell& width) {
  const auto* const text = std::get_if<std::string>(&indenter);
  const int place = text ? find_name(ChoiceNames<Indenter>::names, *text) : -1;
  if (place < 0) return std::nullopt;
  return Body(static_cast<Indenter>(place), !std::holds_alternative<std::monostate>(width));
}

Table shown_table(Table table, const ShownColumns& columns, ShownUnits units) {
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const QuantityColumn* const quantity = columns.quantities[i];
    if (!quantity) continue;
    const auto unit = common_unit(*quantity, columns);
    if (units == ShownUnits::si) {
      if (unit) table.columns[i] += unit_in_brackets(*unit);
      continue;
    }
    if (!unit) {
      show_one_by_one(table, i, *quantity, columns);
      continue;
    }
    const ScaledUnit scaled = scale_of(numbers_in(table, i), *quantity, *unit, AxisScale::automatic, false, "").unit;
    table.columns[i] += unit_in_brackets(typeset_unit(scaled.name));
    for (auto& row : table.rows)
      if (auto* const number = std::get_if<double>(&row[i]); number && std::isfinite(*number))
        *number = units == ShownUnits::scaled ? to_digits(scaled.number(*number)) : scaled.number(*number);
  }
  return table;
}

Table shown_rows(const Database& database, Query query, const FormulaDefinitions& formulas, ShownUnits units,
                 const std::vector<std::string>& headings) {
  ShownColumns shown;
  for (const std::string& name : query.columns) shown.quantities.push_back(quantity_in(name, formulas));
  const bool needs_body = differs_by_body(shown);
  if (needs_body) query.columns.insert(query.columns.end(), {"indenter", "width"});
  Table table = run_query(database, query);
  if (needs_body) {
    const std::size_t own = table.columns.size() - 2;
    table.columns.resize(own);
    for (auto& row : table.rows) {
      shown.bodies.push_back(body_in(row[own], row[own + 1]));
      row.resize(own);
    }
  }
  if (!headings.empty()) table.columns = headings;
  return shown_table(std::move(table), shown, units);
}

Table shown_groups(const Database& database, const GroupQuery& query, const FormulaDefinitions& formulas,
                   ShownUnits units) {
  GroupColumns columns(query, formulas);
  if (!differs_by_body(columns.shown)) return shown_table(run_group_query(database, query), columns.shown, units);
  const Cell common = common_indenter(database, query);
  const auto by_body = std::find(query.by.begin(), query.by.end(), "indenter");
  GroupQuery counting = query;
  counting.aggregates.insert(counting.aggregates.end(), {{Statistic::count, "indenter"}, {Statistic::count, "width"}});
  Table table = run_group_query(database, counting);
  const std::size_t own = table.columns.size() - 2;
  table.columns.resize(own);
  for (auto& row : table.rows) {
    const bool any = row[own + 1] != Cell(std::int64_t{0}), all = row[own] == row[own + 1];
    const Cell indenter =
        by_body == query.by.end() ? common : row[static_cast<std::size_t>(by_body - query.by.begin())];
    columns.shown.bodies.push_back(any && !all ? std::nullopt : body_in(indenter, any ? Cell(1.0) : Cell()));
    row.resize(own);
  }
  return shown_table(std::move(table), columns.shown, units);
}

std::vector<std::string> varied_columns(const Database& database, const Query& query) {
  bool of_study = false;
  for (const Filter& filter : query.filters) of_study = of_study || find_name(point_columns, filter.column) >= 0;
  for (const std::string& name : query.sort) of_study = of_study || find_name(point_columns, sorted_by(name)) >= 0;
  const auto names = candidates(database, of_study);
  Query all = query;
  all.columns.clear();
  for (const auto& [compared, shown] : names) all.columns.push_back(compared);
  const std::vector<bool> varies = columns_that_vary(database, all);
  std::vector<std::string> varied;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!varies[i]) continue;
    const InputKind* const kind = find_input(names[i].first);
    if (kind && kind->layers)
      for (std::string& key : varied_in_layers(database, all, kind->quantity.key)) varied.push_back(std::move(key));
    else
      varied.push_back(names[i].second);
  }
  return varied;
}

std::vector<std::string> fit_to_width(Table& table, std::size_t width, const std::vector<std::string>& droppable) {
  std::vector<std::string> dropped;
  for (auto key = droppable.rbegin(); key != droppable.rend() && aligned_width(table) > width; ++key) {
    const auto place = find_if(
        table.columns, [&](const std::string& heading) { return heading == *key || heading.starts_with(*key + " ["); });
    if (place == table.columns.end()) continue;
    const auto column = place - table.columns.begin();
    dropped.insert(dropped.begin(), *key);
    table.columns.erase(place);
    for (auto& row : table.rows) row.erase(row.begin() + column);
  }
  return dropped;
}

}  // namespace rollres
