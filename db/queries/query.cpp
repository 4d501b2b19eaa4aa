#include "db/queries/query.hpp"

#include <algorithm>

#include "db/queries/select.hpp"

namespace rollres {

namespace {

bool is_of_summary(const std::string& column) {
  return std::find(summary_columns.begin(), summary_columns.end(), column) != summary_columns.end();
}

bool needs_study(const Query& query) {
  return any_of_study(query.filters) || std::any_of(query.columns.begin(), query.columns.end(), of_study) ||
         std::any_of(query.sort.begin(), query.sort.end(),
                     [](const std::string& text) { return of_study(SortKey(text).column); });
}

/// Whether the columns that select and order the rows are all in the summary, or of the study.
bool summary_decides(const Query& query) {
  auto decides = [](const std::string& column) { return is_of_summary(column) || of_study(column); };
  return std::all_of(query.filters.begin(), query.filters.end(),
                     [&](const Filter& filter) { return decides(filter.column); }) &&
         std::all_of(query.sort.begin(), query.sort.end(),
                     [&](const std::string& text) { return decides(SortKey(text).column); });
}

/// Whether the first page of a study is found quicker in the summary, looking up which rows are points of it, than by
/// reading the rows of all its points. In the summary's own order the search ends when the page is full.
bool better_from_summary(SQLite::Database& connection, const Query& query) {
  if (!query.limit || query.sort.empty() || !summary_decides(query)) return false;
  const auto study = std::find_if(query.filters.begin(), query.filters.end(), [](const Filter& filter) {
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
    "(SELECT study.name AS study, study_point.position AS position, evaluation.* FROM study CROSS JOIN evaluation "
    "CROSS JOIN study_point ON study_point.key = evaluation.key AND study_point.study = study.id)";

}  // namespace

Table run_query(const Database& database, const Query& query) {
  return naming(database.name(), [&] {
    SQLite::Database& connection = database.connection();
    const bool with_study = needs_study(query);
    const std::string view = with_study ? "result" : "evaluation";
    const Columns known = columns_of(connection, view);

    std::string columns;
    for (const std::string& name : query.columns)
      columns += (columns.empty() ? "" : ", ") + column_named(known, name).sql();
    std::vector<Cell> bound;
    const std::string where = where_clause(query.filters, known, bound);
    std::string order = order_terms(query.sort, known);
    const std::string limit = limit_clause(query.limit, bound);
    const std::string select = "SELECT " + (columns.empty() ? "*" : columns) + " FROM ";
    std::string sql;
    if (with_study) {
      const bool from_summary = better_from_summary(connection, query);
      sql = select + (from_summary ? result_from_summary : view) + where + " ORDER BY " + order + "study, position" +
            limit;
    } else if (query.limit && !where.empty() && summary_decides(query)) {
      // The page is found in the index alone, the other columns are read for its rows only.
      sql = select + "evaluation WHERE id IN (SELECT id FROM evaluation" + where + " ORDER BY " + order + "+id" +
            limit + ") ORDER BY " + order + "id";
    } else {
      // A plus keeps SQLite from following an index that the filters cannot use: a scan is quicker.
      const bool may_follow = where.empty() || summary_decides(query);
      sql = select + view + where + " ORDER BY " + (order.empty() || may_follow ? "" : "+") + order + "id" + limit;
    }
    Table table = rows_of(connection, sql, bound);
    if (!query.columns.empty()) table.columns = query.columns;
    return table;
  });
}

}  // namespace rollres
