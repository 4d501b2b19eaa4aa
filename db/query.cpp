#include "db/query.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "db/schema.hpp"
#include "db/sqlite.hpp"

namespace rollres {

namespace {

using Columns = std::vector<Column>;

const Column& column_named(const Columns& columns, const std::string& name) {
  const auto found = std::find_if(columns.begin(), columns.end(), [&](const Column& one) { return one.name == name; });
  if (found != columns.end()) return *found;
  std::vector<std::string_view> names;
  for (const Column& column : columns) names.push_back(column.name);
  const std::string nearest = nearest_name(names, name);
  throw std::invalid_argument(name + ": unknown column" +
                              (nearest.empty() ? "; see rollres quantities" : "; did you mean " + nearest + "?"));
}

double number_in(const Filter& filter) {
  if (filter.value == "infinite") return std::numeric_limits<double>::infinity();
  const char* begin = filter.value.data();
  const char* end = begin + filter.value.size();
  if (begin != end && *begin == '+') ++begin;
  double value = 0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || stop != end || std::isnan(value))
    throw std::invalid_argument(filter.column + " = " + filter.value + ": must be a number");
  return value;
}

/// SQL of a condition; appends what it binds.
std::string condition(const Filter& filter, const Column& column, std::vector<Cell>& bound) {
  const std::string& name = column.name;
  const bool equal = filter.comparison == Comparison::equal, differs = filter.comparison == Comparison::not_equal;
  if (filter.value.empty()) {
    const std::string absent = "(" + name + " IS NULL" + (column.type == "TEXT" ? " OR " + name + " = '')" : ")");
    if (equal) return absent;
    if (differs) return "NOT " + absent;
    throw std::invalid_argument(filter.column + ": needs a value to compare with");
  }
  if (filter.comparison == Comparison::contains) {
    bound.emplace_back(filter.value);
    return "instr(" + name + ", ?) > 0";
  }
  if (column.type == "TEXT") {
    constexpr const char* operators[] = {" = ?", " IS NOT ?", " < ?", " <= ?", " > ?", " >= ?"};
    bound.emplace_back(filter.value);
    return name + operators[static_cast<int>(filter.comparison)];
  }
  const double value = number_in(filter);
  const double slack = std::isinf(value) ? 0.0 : 1e-12 * std::abs(value);
  const double low = value - slack, high = value + slack;
  switch (filter.comparison) {
    case Comparison::equal:
    case Comparison::not_equal:
      bound.emplace_back(low);
      bound.emplace_back(high);
      return equal ? name + " BETWEEN ? AND ?" : "(" + name + " IS NULL OR " + name + " NOT BETWEEN ? AND ?)";
    case Comparison::less:
      bound.emplace_back(low);
      return name + " < ?";
    case Comparison::less_or_equal:
      bound.emplace_back(high);
      return name + " <= ?";
    case Comparison::greater:
      bound.emplace_back(high);
      return name + " > ?";
    default:
      bound.emplace_back(low);
      return name + " >= ?";
  }
}

bool of_study(const std::string& column) { return column == "study" || column == "position"; }

std::string unsigned_name(const std::string& sort) { return sort.starts_with('-') ? sort.substr(1) : sort; }

bool needs_study(const Query& query) {
  return std::any_of(query.filters.begin(), query.filters.end(),
                     [](const Filter& one) { return of_study(one.column); }) ||
         std::any_of(query.columns.begin(), query.columns.end(), of_study) ||
         std::any_of(query.sort.begin(), query.sort.end(),
                     [](const auto& one) { return of_study(unsigned_name(one)); });
}

Cell read_cell(const SQLite::Column& column) {
  if (column.isNull()) return std::monostate{};
  if (column.isInteger()) return column.getInt64();
  if (column.isFloat()) return column.getDouble();
  return column.getString();
}

}  // namespace

Filter parse_filter(std::string_view text) {
  const std::size_t begin = text.find_first_of("=!<>~");
  if (begin == std::string_view::npos || begin == 0)
    throw std::invalid_argument(std::string(text) + ": must be a column, one of = != < <= > >= ~ and a value");
  const bool twofold = begin + 1 < text.size() && text[begin + 1] == '=' && text[begin] != '~';
  const std::string_view sign = text.substr(begin, twofold ? 2 : 1);
  constexpr std::pair<std::string_view, Comparison> signs[] = {{"=", Comparison::equal},
                                                               {"==", Comparison::equal},
                                                               {"!=", Comparison::not_equal},
                                                               {"<", Comparison::less},
                                                               {"<=", Comparison::less_or_equal},
                                                               {">", Comparison::greater},
                                                               {">=", Comparison::greater_or_equal},
                                                               {"~", Comparison::contains}};
  const auto known =
      std::find_if(std::begin(signs), std::end(signs), [&](const auto& one) { return one.first == sign; });
  if (known == std::end(signs))
    throw std::invalid_argument(std::string(text) + ": a single ! compares nothing; use !=");
  auto trimmed = [](std::string_view word) {
    while (word.starts_with(' ')) word.remove_prefix(1);
    while (word.ends_with(' ')) word.remove_suffix(1);
    return std::string(word);
  };
  return {trimmed(text.substr(0, begin)), known->second, trimmed(text.substr(begin + sign.size()))};
}

Table run_query(const Database& database, const Query& query) {
  return naming(database.name(), [&] {
    SQLite::Database& connection = database.connection();
    const bool with_study = needs_study(query);
    const std::string source = with_study ? "result" : "evaluation";
    const Columns known = columns_of(connection, source);
    Table table;
    table.columns = query.columns;
    if (table.columns.empty())
      for (const Column& column : known) table.columns.push_back(column.name);

    std::string sql, order;
    std::vector<Cell> bound;
    for (const std::string& name : table.columns)
      sql += (sql.empty() ? "SELECT " : ", ") + column_named(known, name).name;
    sql += " FROM " + source;
    std::string glue = " WHERE ";
    for (const Filter& filter : query.filters) {
      sql += glue + condition(filter, column_named(known, filter.column), bound);
      glue = " AND ";
    }
    for (const std::string& key : query.sort)
      order += column_named(known, unsigned_name(key)).name + (key.starts_with('-') ? " DESC" : "") + " NULLS LAST, ";
    sql += " ORDER BY " + order + (with_study ? "study, position" : "id");
    if (query.limit) {
      if (*query.limit < 0) throw std::invalid_argument("limit = " + std::to_string(*query.limit) + ": must be >= 0");
      sql += " LIMIT ?";
      bound.emplace_back(*query.limit);
    }

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
    while (statement.executeStep()) {
      std::vector<Cell>& row = table.rows.emplace_back();
      for (int column = 0; column < statement.getColumnCount(); ++column)
        row.push_back(read_cell(statement.getColumn(column)));
    }
    return table;
  });
}

}  // namespace rollres
