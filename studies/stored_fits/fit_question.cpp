#include "studies/stored_fits/fit_question.hpp"

#include <algorithm>
#include <deque>
#include <stdexcept>

#include "fitting/fit/fit_report.hpp"
#include "studies/stored/derived_columns.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

/// The parameter that a column is of, and what it holds of it: a place of parameter_columns.
struct OfParameter {
  const StoredParameter* parameter = nullptr;
  std::size_t part = 0;
};

OfParameter parameter_of(const std::vector<StoredParameter>& all, const std::string& column) {
  for (const StoredParameter& one : all)
    for (std::size_t part = 0; part < parameter_columns.size(); ++part)
      if (column == one.name + std::string(parameter_columns[part])) return {&one, part};
  return {};
}

/// As a quantity: errors are differences, of which no temperature is one in degrees Celsius.
Quantity quantity_of(const OfParameter& of) {
  constexpr std::size_t error = 1;
  return {.key = of.part == error ? std::string_view("difference") : std::string_view(of.parameter->name),
          .symbol = {},
          .unit = of.parameter->unit,
          .meaning = {}};
}

void drop_empty(Table& table, const std::vector<StoredParameter>& parameters) {
  for (std::size_t i = table.columns.size(); i-- > 0;) {
    const bool empty =
        all_of(table.rows, [&](const auto& row) { return std::holds_alternative<std::monostate>(row[i]); });
    if (!empty || !parameter_of(parameters, table.columns[i]).parameter) continue;
    table.columns.erase(table.columns.begin() + static_cast<std::ptrdiff_t>(i));
    for (auto& row : table.rows) row.erase(row.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

/// The measured values, then the parameters, those of most fits first, then their errors.
std::vector<std::string> droppable_of(const Table& table, const std::vector<StoredParameter>& parameters) {
  std::vector<std::pair<std::size_t, std::string>> names;  // how many fits lack it
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const OfParameter of = parameter_of(parameters, table.columns[i]);
    if (!of.parameter) continue;
    const auto lacking = static_cast<std::size_t>(
        count_if(table.rows, [&](const auto& row) { return std::holds_alternative<std::monostate>(row[i]); }));
    names.emplace_back(lacking + (of.part > 0 ? table.rows.size() : 0), table.columns[i]);
  }
  stable_sort(names, [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> droppable{"values"};
  for (auto& [lacking, name] : names) droppable.push_back(std::move(name));
  return droppable;
}

}  // namespace

Filter read_fit_filter(const Database& database, const std::string& text) {
  Filter filter = parse_filter(text);
  const std::vector<StoredParameter> parameters = fitted_parameters(database);
  const OfParameter of = parameter_of(parameters, filter.column);
  if (of.parameter) convert_written(filter, quantity_of(of));
  if (filter.column == "seconds") convert_to_si(filter, Quantity{"seconds", "", "s", ""});
  const bool compares = filter.comparison == Comparison::equal || filter.comparison == Comparison::not_equal;
  if (filter.column != "status" || !compares || filter.value.empty()) return filter;
  constexpr const auto& statuses = ChoiceNames<FitStatus>::names;
  const auto same = [&](std::string_view one) {
    return std::equal(one.begin(), one.end(), filter.value.begin(), filter.value.end(), [](char a, char b) {
      return std::toupper(static_cast<unsigned char>(a)) == std::toupper(static_cast<unsigned char>(b));
    });
  };
  const auto found = find_if(statuses, same);
  if (found == statuses.end())
    throw std::invalid_argument("status = " + filter.value + ": must be one of " + joined(statuses));
  filter.value = *found;
  return filter;
}

ShownFits shown_fits(const Database& database, Query query, ShownUnits units) {
  const std::vector<StoredParameter> parameters = fitted_parameters(database);
  ShownFits shown;
  const bool chosen = query.columns.empty();
  if (chosen) {
    query.columns = {"name", "status", "values", "reduced_chi_squared"};
    const auto add = [&](const std::string& name) {
      if (!contains(query.columns, name)) query.columns.push_back(name);
    };
    for (const Filter& filter : query.filters)
      if (filter.comparison != Comparison::equal) add(filter.column);
    for (const std::string& name : query.sort) add(name.substr(name.starts_with('-') ? 1 : 0));
    for (const StoredParameter& one : parameters)
      for (const char* const part : {"", "_error"}) add(one.name + part);
  }
  Table table = run_fit_query(database, query);
  if (chosen) {
    drop_empty(table, parameters);
    shown.droppable = droppable_of(table, parameters);
  }
  ShownColumns columns;
  std::deque<QuantityColumn> kept;
  for (const std::string& name : table.columns) {
    const OfParameter of = parameter_of(parameters, name);
    columns.quantities.push_back(nullptr);
    if (of.parameter && !of.parameter->unit.empty())
      columns.quantities.back() = &kept.emplace_back(QuantityColumn{{name, "REAL"}, quantity_of(of)});
  }
  shown.table = shown_table(std::move(table), columns, units);
  for (auto& row : shown.table.rows)
    for (Cell& cell : row)
      if (auto* const number = std::get_if<double>(&cell); number && units == ShownUnits::scaled)
        *number = to_digits(*number);
  return shown;
}

}  // namespace rollres
