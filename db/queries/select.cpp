#include "db/queries/select.hpp"

#include <algorithm>
#include <stdexcept>

#include "core/scene/scene_input.hpp"

namespace rollres {

namespace {

Cell read_cell(const SQLite::Column& column) {
  if (column.isNull()) return std::monostate{};
  if (column.isInteger()) return column.getInt64();
  if (column.isFloat()) return column.getDouble();
  if (column.isBlob()) return std::to_string(column.getBytes()) + " bytes";
  return column.getString();
}

}  // namespace

const Column& column_named(const Columns& columns, const std::string& name) {
  const auto found = std::find_if(columns.begin(), columns.end(), [&](const Column& one) { return one.name == name; });
  if (found != columns.end()) return *found;
  std::vector<std::string_view> names;
  for (const Column& column : columns) names.push_back(column.name);
  if (const std::optional<LayerKey> layered = layer_key(name); layered && find_name(names, layered->list) >= 0) {
    if (const QuantityColumn* const column = find_quantity_column(name)) return *column;
    for (const std::string_view key : keys_like(name))
      if (layer_key(key)) names.push_back(key);
  }
  const std::string nearest = nearest_name(names, name);
  throw std::invalid_argument(name + ": unknown column" +
                              (nearest.empty() ? "; see rollres quantities" : "; did you mean " + nearest + "?"));
}

bool of_study(const std::string& column) { return column == "study" || column == "position"; }

bool any_of_study(const std::vector<Filter>& filters) {
  return std::any_of(filters.begin(), filters.end(), [](const Filter& one) { return of_study(one.column); });
}

SortKey::SortKey(const std::string& text)
    : column(text.starts_with('-') ? text.substr(1) : text), falling(text.starts_with('-')) {}

std::string order_terms(const std::vector<std::string>& sort, const Columns& known) {
  std::string terms;
  for (const std::string& text : sort) {
    const SortKey key(text);
    terms += column_named(known, key.column).sql() + (key.falling ? " DESC" : "") + " NULLS LAST, ";
  }
  return terms;
}

std::string quoted_name(const std::string& name) { return '"' + name + '"'; }

std::string limit_clause(const std::optional<std::int64_t>& limit, std::vector<Cell>& bound) {
  if (!limit) return "";
  if (*limit < 0) throw std::invalid_argument("limit = " + std::to_string(*limit) + ": must be >= 0");
  bound.emplace_back(*limit);
  return " LIMIT ?";
}

Table rows_of(SQLite::Statement& statement) {
  Table table;
  for (int column = 0; column < statement.getColumnCount(); ++column)
    table.columns.emplace_back(statement.getColumnName(column));
  while (statement.executeStep()) {
    std::vector<Cell>& row = table.rows.emplace_back();
    for (int column = 0; column < statement.getColumnCount(); ++column)
      row.push_back(read_cell(statement.getColumn(column)));
  }
  return table;
}

Table rows_of(SQLite::Database& connection, const std::string& sql, const std::vector<Cell>& bound) {
  SQLite::Statement statement(connection, sql);
  int index = 0;
  for (const Cell& value : bound) {
    ++index;
    if (const auto* count = std::get_if<std::int64_t>(&value))
      statement.bind(index, *count);
    else if (const auto* number = std::get_if<double>(&value))
      statement.bind(index, *number);
    else
      statement.bind(index, std::get<std::string>(value));
  }
  return rows_of(statement);
}

}  // namespace rollres
