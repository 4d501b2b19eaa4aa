#include "db/queries/select.hpp"

#include <sqlite3.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <memory>
#include <new>
#include <stdexcept>

#include "core/scene/scene_input.hpp"
#include "db/file/digest.hpp"

namespace rollres {

namespace {

/// A statement of SQLite's own interface: its wrapper takes ten times as long to hand out a cell.
class Rows {
 public:
  Rows(SQLite::Database& connection, const std::string& sql, const std::vector<Cell>& bound)
      : handle_(connection.getHandle()) {
    sqlite3_stmt* prepared = nullptr;
    require(sqlite3_prepare_v2(handle_, sql.c_str(), static_cast<int>(sql.size()), &prepared, nullptr), SQLITE_OK);
    statement_.reset(prepared);
    int index = 0;
    for (const Cell& value : bound) {
      ++index;
      if (const auto* count = std::get_if<std::int64_t>(&value))
        require(sqlite3_bind_int64(statement_.get(), index, *count), SQLITE_OK);
      else if (const auto* number = std::get_if<double>(&value))
        require(sqlite3_bind_double(statement_.get(), index, *number), SQLITE_OK);
      else
        bind_text(index, std::get<std::string>(value));
    }
  }

  int columns() const { return sqlite3_column_count(statement_.get()); }
  std::string name(int column) const { return sqlite3_column_name(statement_.get(), column); }
  bool next() {
    const int code = sqlite3_step(statement_.get());
    if (code != SQLITE_DONE) require(code, SQLITE_ROW);
    return code == SQLITE_ROW;
  }
  Cell cell(int column) const {
    switch (sqlite3_column_type(statement_.get(), column)) {
      case SQLITE_NULL:
        return std::monostate{};
      case SQLITE_INTEGER:
        return std::int64_t{sqlite3_column_int64(statement_.get(), column)};
      case SQLITE_FLOAT:
        return sqlite3_column_double(statement_.get(), column);
      case SQLITE_BLOB:
        return std::to_string(sqlite3_column_bytes(statement_.get(), column)) + " bytes";
      default: {
        const auto* const text = reinterpret_cast<const char*>(sqlite3_column_text(statement_.get(), column));
        return std::string(text, static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column)));
      }
    }
  }

 private:
  void bind_text(int index, const std::string& text) {
    require(sqlite3_bind_text(statement_.get(), index, text.c_str(), static_cast<int>(text.size()), SQLITE_TRANSIENT),
            SQLITE_OK);
  }
  void require(int code, int wanted) const {
    if (code != wanted) throw SQLite::Exception(handle_, code);
  }

  sqlite3* handle_;
  std::unique_ptr<sqlite3_stmt, decltype(&sqlite3_finalize)> statement_{nullptr, sqlite3_finalize};
};

bool is_number(sqlite3_value* value) {
  const int type = sqlite3_value_numeric_type(value);
  return type == SQLITE_FLOAT || type == SQLITE_INTEGER;
}

/// By Welford's recurrence (1962).
struct Spread {
  std::int64_t count;
  double mean, squares;
};

void add_to_spread(sqlite3_context* context, int, sqlite3_value** values) {
  if (!is_number(values[0])) return;
  auto* const spread = static_cast<Spread*>(sqlite3_aggregate_context(context, sizeof(Spread)));
  if (!spread) return sqlite3_result_error_nomem(context);
  const double value = sqlite3_value_double(values[0]), step = value - spread->mean;
  spread->mean += step / static_cast<double>(++spread->count);
  spread->squares += step * (value - spread->mean);
}

void finish_spread(sqlite3_context* context) {
  const auto* const spread = static_cast<Spread*>(sqlite3_aggregate_context(context, 0));
  if (spread && spread->count > 1)
    sqlite3_result_double(context, std::sqrt(spread->squares / static_cast<double>(spread->count - 1)));
}

using Numbers = std::vector<double>;

void add_to_numbers(sqlite3_context* context, int, sqlite3_value** values) {
  if (!is_number(values[0])) return;
  auto** const numbers = static_cast<Numbers**>(sqlite3_aggregate_context(context, sizeof(Numbers*)));
  try {
    if (!numbers) throw std::bad_alloc();
    if (!*numbers) *numbers = new Numbers;
    (*numbers)->push_back(sqlite3_value_double(values[0]));
  } catch (const std::bad_alloc&) {
    sqlite3_result_error_nomem(context);
  }
}

/// SQLite calls it for everything that was begun, also after an error.
void finish_median(sqlite3_context* context) {
  auto** const kept = static_cast<Numbers**>(sqlite3_aggregate_context(context, 0));
  if (!kept || !*kept) return;
  const std::unique_ptr<Numbers> numbers(*kept);
  *kept = nullptr;
  if (numbers->empty()) return;
  const auto middle = numbers->begin() + static_cast<std::ptrdiff_t>(numbers->size() / 2);
  std::nth_element(numbers->begin(), middle, numbers->end());
  double median = *middle;
  if (numbers->size() % 2 == 0) median = 0.5 * (median + *std::max_element(numbers->begin(), middle));
  sqlite3_result_double(context, median);
}

void round_number(sqlite3_context* context, int, sqlite3_value** values) {
  if (sqlite3_value_type(values[0]) != SQLITE_FLOAT) return sqlite3_result_value(context, values[0]);
  double value = sqlite3_value_double(values[0]);
  if (std::isfinite(value)) {
    const std::string text = twelve_digits(value);
    std::from_chars(text.data(), text.data() + text.size(), value);
  }
  sqlite3_result_double(context, value);
}

/// Calls the function of a computed column.
void compute_value(sqlite3_context* context, int count, sqlite3_value** values) {
  const auto& column = *static_cast<const ComputedColumn*>(sqlite3_user_data(context));
  try {
    std::vector<double> numbers;
    for (int i = 0; i < count; ++i)
      numbers.push_back(is_number(values[i]) ? sqlite3_value_double(values[i])
                                             : std::numeric_limits<double>::quiet_NaN());
    if (const double value = column.value(numbers); !std::isnan(value)) sqlite3_result_double(context, value);
  } catch (const std::exception& error) {
    sqlite3_result_error(context, (column.name + ": " + error.what()).c_str(), -1);
  }
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
  const std::string name = column.sql();
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
  constexpr const char* operators[] = {" = ?", " IS NOT ?", " < ?", " <= ?", " > ?", " >= ?"};
  const std::string compared = name + operators[static_cast<int>(filter.comparison)];
  if (column.type == "TEXT") {
    bound.emplace_back(filter.value);
    return compared;
  }
  const double value = number_in(filter);
  const double slack = std::isinf(value) ? 0.0 : filter.slack * std::abs(value);
  if (equal || differs) {
    bound.emplace_back(value - slack);
    bound.emplace_back(value + slack);
    return equal ? name + " BETWEEN ? AND ?" : "(" + name + " IS NULL OR " + name + " NOT BETWEEN ? AND ?)";
  }
  const bool beyond = filter.comparison == Comparison::less_or_equal || filter.comparison == Comparison::greater;
  bound.emplace_back(beyond ? value + slack : value - slack);
  return compared;
}

/// The condition, for rows of bodies that have the unit of the filter's value; all others differ from it.
std::string condition_with_unit(const Filter& filter, const Columns& known, std::vector<Cell>& bound) {
  const std::string one = condition(filter, column_named(known, filter.column), bound);
  if (!filter.per_metre || !has_column(known, "indenter") || !has_column(known, "width")) return one;
  const std::string metre = "(" + column_named(known, "indenter").sql() + " = 'cylinder' AND " +
                            column_named(known, "width").sql() + " IS NULL)";
  const std::string same = (*filter.per_metre ? "" : "NOT ") + metre;
  return filter.comparison == Comparison::not_equal ? "(NOT (" + same + ") OR " + one + ")"
                                                    : "(" + same + " AND " + one + ")";
}

bool names_study(const Filter& filter) {
  return filter.column == "study" && filter.comparison == Comparison::equal && !filter.value.empty();
}

}  // namespace

std::ptrdiff_t studies_named(const std::vector<Filter>& filters) { return count_if(filters, names_study); }

bool has_column(const Columns& columns, const std::string& name) {
  return any_of(columns, [&](const Column& one) { return one.name == name; });
}

const Column& column_named(const Columns& columns, const std::string& name) {
  const auto found = find_if(columns, [&](const Column& one) { return one.name == name; });
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

bool of_study(const std::string& column) { return contains(point_columns, column); }

bool any_of_study(const std::vector<Filter>& filters) {
  return any_of(filters, [](const Filter& one) { return of_study(one.column); });
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

std::string limit_clause(const std::optional<std::int64_t>& limit, std::vector<Cell>& bound, std::int64_t offset) {
  if (!limit) return "";
  if (*limit < 0) throw std::invalid_argument("limit = " + std::to_string(*limit) + ": must be >= 0");
  bound.emplace_back(*limit);
  if (offset == 0) return " LIMIT ?";
  bound.emplace_back(offset);
  return " LIMIT ? OFFSET ?";
}

Table rows_of(SQLite::Database& connection, const std::string& sql, const std::vector<Cell>& bound) {
  Rows rows(connection, sql, bound);
  Table table;
  const int count = rows.columns();
  for (int column = 0; column < count; ++column) table.columns.push_back(rows.name(column));
  while (rows.next()) {
    std::vector<Cell>& row = table.rows.emplace_back();
    row.reserve(static_cast<std::size_t>(count));
    for (int column = 0; column < count; ++column) row.push_back(rows.cell(column));
  }
  return table;
}

ColumnTable columns_of_rows(SQLite::Database& connection, const std::string& sql, const std::vector<Cell>& bound) {
  Rows rows(connection, sql, bound);
  ColumnTable table;
  const int count = rows.columns();
  for (int column = 0; column < count; ++column) table.names.push_back(rows.name(column));
  table.columns.resize(static_cast<std::size_t>(count));
  for (; rows.next(); ++table.rows)
    for (int column = 0; column < count; ++column)
      table.columns[static_cast<std::size_t>(column)].add(rows.cell(column));
  return table;
}

Columns known_columns(SQLite::Database& connection, const std::string& view) {
  Columns known = columns_of(connection, view);
  for (const QuantityColumn& column : quantity_columns())
    if (!has_column(known, column.name)) known.push_back({column.name, column.type, "NULL"});
  return known;
}

void add_functions(SQLite::Database& connection) {
  connection.createFunction("stddev", 1, true, nullptr, nullptr, add_to_spread, finish_spread);
  connection.createFunction("median", 1, true, nullptr, nullptr, add_to_numbers, finish_median);
  connection.createFunction("rounded", 1, true, nullptr, round_number);
}

void add_computed(SQLite::Database& connection, const std::vector<ComputedColumn>& computed, Columns& known) {
  Columns columns;
  for (const ComputedColumn& column : computed) {
    const std::string function = "computed_" + std::to_string(columns.size());
    std::string arguments;
    for (const std::string& name : column.of)
      arguments += (arguments.empty() ? "" : ", ") + column_named(known, name).sql();
    auto kept = std::make_unique<ComputedColumn>(column);
    connection.createFunction(function.c_str(), static_cast<int>(column.of.size()), true, kept.release(), compute_value,
                              nullptr, nullptr, [](void* one) { delete static_cast<ComputedColumn*>(one); });
    columns.push_back({column.name, "REAL", function + "(" + arguments + ")"});
  }
  known.insert(known.end(), columns.begin(), columns.end());
}

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
  Filter filter{trimmed(text.substr(0, begin)), known->second, trimmed(text.substr(begin + sign.size()))};
  filter.slack = slack_of_written(filter.value);
  return filter;
}

double slack_of_written(std::string_view text) {
  double number = 0;
  const std::size_t sign = text.starts_with('+') || text.starts_with('-') ? 1 : 0;
  const auto [end, error] = std::from_chars(text.data() + sign, text.data() + text.size(), number);
  if (error != std::errc() || !(number > 0) || std::isinf(number)) return 0;
  const std::string_view written(text.data() + sign, static_cast<std::size_t>(end - text.data()) - sign);
  const std::string_view mantissa = written.substr(0, written.find_first_of("eE"));
  const std::size_t first = mantissa.find_first_not_of("0.");
  const auto digits = std::count_if(mantissa.begin() + static_cast<std::ptrdiff_t>(first), mantissa.end(),
                                    [](char letter) { return letter != '.'; });
  constexpr std::ptrdiff_t fewest_shown = 5;
  const double leading = std::pow(10, std::floor(std::log10(number) + 1e-15));
  const double half_unit = 0.5 * leading * std::pow(0.1, static_cast<double>(std::max(digits, fewest_shown) - 1));
  return std::max(half_unit / number, 1e-12);
}

std::string where_clause(const std::vector<Filter>& filters, const Columns& known, std::vector<Cell>& bound) {
  std::string clause, studies;
  const auto add = [&](const std::string& one) { clause += (clause.empty() ? " WHERE " : " AND ") + one; };
  const bool several = studies_named(filters) > 1;
  for (const Filter& filter : filters)
    if (!several || !names_study(filter)) add(condition_with_unit(filter, known, bound));
  for (const Filter& filter : filters)
    if (several && names_study(filter))
      studies += (studies.empty() ? "" : " OR ") + condition(filter, column_named(known, filter.column), bound);
  if (several) add("(" + studies + ")");
  return clause;
}

}  // namespace rollres
