#include "db/queries/query.hpp"

#include <sqlite3.h>

#include <iterator>
#include <sstream>
#include <stdexcept>

#include "core/messages/message_text.hpp"
#include "db/queries/select.hpp"

namespace rollres {

namespace {

bool is_of_summary(const std::string& column) { return contains(summary_columns, column); }

bool needs_study(const Query& query) {
  return any_of_study(query.filters) || any_of(query.columns, of_study) ||
         any_of(query.sort, [](const std::string& text) { return of_study(SortKey(text).column); });
}

/// Whether the columns that select and order the rows are all in the summary, or of the study.
bool summary_decides(const Query& query) {
  auto decides = [](const std::string& column) { return is_of_summary(column) || of_study(column); };
  return all_of(query.filters, [&](const Filter& filter) { return decides(filter.column); }) &&
         all_of(query.sort, [&](const std::string& text) { return decides(SortKey(text).column); });
}

/// Whether the first page of a study is found quicker in the summary, looking up which rows are points of it, than by
/// reading the rows of all its points. In the summary's own order the search ends when the page is full.
bool better_from_summary(SQLite::Database& connection, const Query& query) {
  if (!query.limit || query.sort.empty() || !summary_decides(query) || studies_named(query.filters) > 1) return false;
  const auto study = find_if(query.filters, [](const Filter& filter) {
    return filter.column == "study" && filter.comparison == Comparison::equal;
  });
  if (study == query.filters.end()) return false;
  SQLite::Statement counts(connection,
                           "SELECT count(*), (SELECT max(id) FROM evaluation) FROM study_point "
                           "WHERE study = (SELECT id FROM study WHERE name = ?)");
  counts.bind(1, study->value);
  counts.executeStep();
  const double points = counts.getColumn(0).getDouble(), all = counts.getColumn(1).getDouble();
  if (SortKey(query.sort.front()).column != summary_columns.front()) return points > 0.3 * all;
  return points * points > static_cast<double>(*query.limit) * all;  // points to read, or limit / points of all rows
}
constexpr const char* result_from_summary =
    "(SELECT study.name AS study, study_point.position AS position, study_point.variant AS variant, "
    "study_point.design AS design, study_point.goal AS goal, study_point.second_goal AS second_goal, "
    "study_point.feasible AS feasible, study_point.front AS front, evaluation.* FROM study CROSS JOIN evaluation "
    "CROSS JOIN study_point ON study_point.key = evaluation.key AND study_point.study = study.id)";

constexpr std::array<std::string_view, ChoiceNames<Statistic>::names.size()> sql_names{"count",  "min",    "max", "avg",
                                                                                       "median", "stddev", "sum"};

std::string expression(const Aggregate& aggregate, const Columns& known) {
  if (aggregate.column.empty()) return "count(*)";
  const Column& column = column_named(known, aggregate.column);
  if (!aggregate.weight.empty()) {
    const Column& weight = column_named(known, aggregate.weight);
    for (const Column* const one : {&column, &weight})
      if (one->type == "TEXT") throw std::invalid_argument(one->name + ": cannot be weighted, it is a text");
    const std::string sum = "sum((" + weight.sql() + ") * (" + column.sql() + "))";
    if (aggregate.statistic == Statistic::sum) return sum;
    return sum + " / sum(CASE WHEN " + column.sql() + " IS NOT NULL THEN " + weight.sql() + " END)";
  }
  if (column.type == "TEXT" && aggregate.statistic != Statistic::count)
    throw std::invalid_argument(aggregate.column + ": has no " + std::string(name_of(aggregate.statistic)) +
                                ", it is a text");
  return std::string(sql_names[static_cast<std::size_t>(aggregate.statistic)]) + "(" + column.sql() + ")";
}

/// Lets a statement read; nothing else.
int allow_reading(void*, int action, const char*, const char*, const char*, const char*) {
  const bool reads =
      action == SQLITE_SELECT || action == SQLITE_READ || action == SQLITE_FUNCTION || action == SQLITE_RECURSIVE;
  return reads ? SQLITE_OK : SQLITE_DENY;
}

struct ReadingOnly {
  sqlite3* handle;
  explicit ReadingOnly(sqlite3* connection) : handle(connection) {
    sqlite3_set_authorizer(handle, allow_reading, nullptr);
  }
  ~ReadingOnly() { sqlite3_set_authorizer(handle, nullptr, nullptr); }
  ReadingOnly(const ReadingOnly&) = delete;
  ReadingOnly& operator=(const ReadingOnly&) = delete;
};

[[noreturn]] void refuse(const std::string& rule) { throw std::invalid_argument("sql: " + rule); }

/// The first statement of a text, by itself.
struct First {
  bool found = false, reads = false;
  const char* rest = nullptr;
};
First first_statement(sqlite3* handle, const char* text) {
  sqlite3_stmt* statement = nullptr;
  First first;
  const int code = sqlite3_prepare_v2(handle, text, -1, &statement, &first.rest);
  if (code == SQLITE_AUTH) refuse("must only read");
  if (code == SQLITE_ERROR) refuse(sqlite3_errmsg(handle));
  if (code != SQLITE_OK) throw SQLite::Exception(handle, code);
  first.found = statement != nullptr;
  first.reads = first.found && sqlite3_stmt_readonly(statement) != 0;
  sqlite3_finalize(statement);
  return first;
}

}  // namespace

namespace {

/// SQL of a question, and what it binds. @param prefix  of the names that the columns get; empty: their own
std::string sql_of(SQLite::Database& connection, const Query& query, std::vector<Cell>& bound,
                   const char* prefix = "") {
  const bool with_study = needs_study(query);
  const std::string view = with_study ? "result" : "evaluation";
  Columns known = known_columns(connection, view);
  add_computed(connection, query.computed, known);

  std::string columns;
  for (std::size_t i = 0; i < query.columns.size(); ++i)
    columns += (i > 0 ? ", " : "") + column_named(known, query.columns[i]).sql() +
               (*prefix ? " AS " + std::string(prefix) + std::to_string(i) : std::string());
  const std::string where = where_clause(query.filters, known, bound);
  std::string order = order_terms(query.sort, known);
  const std::string limit = limit_clause(query.limit, bound, query.offset);
  const std::string select = "SELECT " + (columns.empty() ? "*" : columns) + " FROM ";
  if (with_study) {
    const bool older = !has_column(known, std::string(point_columns.back()));  // a file that is read as it is
    const bool from_summary = !older && better_from_summary(connection, query);
    return select + (from_summary ? result_from_summary : view) + where + " ORDER BY " + order + "study, position" +
           limit;
  }
  // The page is found in the index alone, the other columns are read for its rows only.
  if (query.limit && !where.empty() && summary_decides(query))
    return select + "evaluation WHERE id IN (SELECT id FROM evaluation" + where + " ORDER BY " + order + "+id" + limit +
           ") ORDER BY " + order + "id";
  // A plus keeps SQLite from following an index that the filters cannot use: a scan is quicker.
  const bool may_follow = where.empty() || summary_decides(query);
  return select + view + where + " ORDER BY " + (order.empty() || may_follow ? "" : "+") + order + "id" + limit;
}

}  // namespace

Table run_query(const Database& database, const Query& query) {
  return naming(database.name(), [&] {
    std::vector<Cell> bound;
    const std::string sql = sql_of(database.connection(), query, bound);
    Table table = rows_of(database.connection(), sql, bound);
    if (!query.columns.empty()) table.columns = query.columns;
    return table;
  });
}

ColumnTable run_column_query(const Database& database, const Query& query) {
  return naming(database.name(), [&] {
    std::vector<Cell> bound;
    const std::string sql = sql_of(database.connection(), query, bound);
    const LargeCache cache(database.connection());
    ColumnTable table = columns_of_rows(database.connection(), sql, bound);
    if (!query.columns.empty()) table.names = query.columns;
    return table;
  });
}

std::vector<bool> columns_that_vary(const Database& database, const Query& query) {
  return naming(database.name(), [&] {
    std::vector<Cell> bound;
    Query unordered = query;
    if (!query.limit) unordered.sort.clear();
    const std::string rows = sql_of(database.connection(), unordered, bound, "c");
    std::string select;
    for (std::size_t i = 0; i < query.columns.size(); ++i) {
      const std::string name = "c" + std::to_string(i);
      select += (i > 0 ? ", " : "") +
                ("min(" + name + ") IS NOT max(" + name + ") OR count(" + name + ") NOT IN (0, count(*))");
    }
    const Table found = rows_of(database.connection(), "SELECT " + select + " FROM (" + rows + ")", bound);
    std::vector<bool> varies;
    for (const Cell& cell : found.rows.at(0)) varies.push_back(cell != Cell(std::int64_t{0}));
    return varies;
  });
}

std::string Aggregate::name() const {
  return std::string(name_of(statistic)) + (column.empty() ? "" : "_" + column) + (weight.empty() ? "" : "_weighted");
}

Aggregate parse_aggregate(std::string_view text) {
  std::istringstream stream{std::string(text)};
  std::vector<std::string> words{std::istream_iterator<std::string>(stream), {}};
  if (words.empty()) words.emplace_back();
  const std::string wish = "aggregate = " + std::string(text) + ": ";
  const int found = find_name(ChoiceNames<Statistic>::names, words.front());
  if (found < 0) {
    const std::string nearest = nearest_name(ChoiceNames<Statistic>::names, words.front());
    throw std::invalid_argument(
        wish + (nearest.empty() ? "must be one of " + joined(ChoiceNames<Statistic>::names) + ", and a column"
                                : "did you mean " + nearest + "?"));
  }
  Aggregate aggregate{static_cast<Statistic>(found)};
  if (words.size() == 4 && words[2] == "weighted") {
    if (aggregate.statistic != Statistic::mean && aggregate.statistic != Statistic::sum)
      throw std::invalid_argument(wish + "only a mean and a sum are weighted");
    aggregate.weight = words[3];
    words.resize(2);
  }
  if (words.size() > 2)
    throw std::invalid_argument(
        wish + "must be a statistic and one column, as in mean approach, or mean approach weighted COLUMN");
  if (words.size() == 2) aggregate.column = words[1];
  if (words.size() == 1 && aggregate.statistic != Statistic::count)
    throw std::invalid_argument(wish + "needs a column, as in " + words.front() + " rolling_resistance");
  return aggregate;
}

Table run_group_query(const Database& database, const GroupQuery& query) {
  return naming(database.name(), [&] {
    SQLite::Database& connection = database.connection();
    add_functions(connection);
    const bool with_study =
        any_of_study(query.filters) || any_of(query.by, of_study) ||
        any_of(query.aggregates, [](const Aggregate& aggregate) { return of_study(aggregate.column); });
    const std::string view = with_study ? "result" : "evaluation";
    Columns known = known_columns(connection, view);
    add_computed(connection, query.computed, known);

    std::string select, group, order;
    Columns shown;
    for (const std::string& name : query.by) {
      const Column& column = column_named(known, name);
      select += (shown.empty() ? "" : ", ") + (column.type == "REAL" ? "rounded(" + column.sql() + ")" : column.sql()) +
                " AS " + quoted_name(column.name);
      shown.push_back({column.name, column.type, quoted_name(column.name)});
      group += (group.empty() ? " GROUP BY " : ", ") + std::to_string(shown.size());
      order += std::to_string(shown.size()) + " NULLS LAST, ";
    }
    for (const Aggregate& aggregate : query.aggregates) {
      select += (shown.empty() ? "" : ", ") + expression(aggregate, known) + " AS " + quoted_name(aggregate.name());
      shown.push_back({aggregate.name(), "REAL", quoted_name(aggregate.name())});
    }
    if (shown.empty()) throw std::invalid_argument("aggregate = : must name a statistic, or by a column");
    std::vector<Cell> bound;
    const std::string where = where_clause(query.filters, known, bound);
    order = order_terms(query.sort, shown) + order;
    if (!order.empty()) order = " ORDER BY " + order.substr(0, order.size() - 2);
    const std::string limit = limit_clause(query.limit, bound);
    return rows_of(connection,
                   "SELECT " + select + " FROM " + view + where + group + " HAVING count(*) > 0" + order + limit,
                   bound);
  });
}

Table run_sql(const Database& database, const std::string& sql) {
  return naming(database.name(), [&] {
    SQLite::Database& connection = database.connection();
    add_functions(connection);
    const ReadingOnly guard(connection.getHandle());
    const First first = first_statement(connection.getHandle(), sql.c_str());
    if (sql.find('\0') != std::string::npos) refuse("must have no NUL character");
    if (!first.found) refuse("must be a statement, as in SELECT * FROM resistance");
    if (!first.reads) refuse("must only read");
    if (first_statement(connection.getHandle(), first.rest).found) refuse("must be one statement");
    return rows_of(connection, sql, {});
  });
}

}  // namespace rollres
