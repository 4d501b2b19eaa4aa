#include <algorithm>
#include <stdexcept>

#include "db/file/sql_functions.hpp"
#include "db/queries/select.hpp"

namespace rollres {

namespace {

constexpr std::array<std::string_view, ChoiceNames<Statistic>::names.size()> sql_names{"count",  "min",    "max", "avg",
                                                                                       "median", "stddev", "sum"};

std::string expression(const Aggregate& aggregate, const Columns& known) {
  if (aggregate.column.empty()) return "count(*)";
  const Column& column = column_named(known, aggregate.column);
  if (column.type == "TEXT" && aggregate.statistic != Statistic::count)
    throw std::invalid_argument(aggregate.column + ": has no " + std::string(name_of(aggregate.statistic)) +
                                ", it is a text");
  return std::string(sql_names[static_cast<std::size_t>(aggregate.statistic)]) + "(" + column.sql() + ")";
}

}  // namespace

std::string Aggregate::name() const { return std::string(name_of(statistic)) + (column.empty() ? "" : "_" + column); }

Aggregate parse_aggregate(std::string_view text) {
  const auto blank = [](char letter) { return letter == ' ' || letter == '\t'; };
  std::vector<std::string> words{""};
  for (const char letter : text) {
    if (!blank(letter))
      words.back() += letter;
    else if (!words.back().empty())
      words.emplace_back();
  }
  if (words.size() > 1 && words.back().empty()) words.pop_back();
  const std::string wish = "aggregate = " + std::string(text) + ": ";
  const int found = find_name(ChoiceNames<Statistic>::names, words.front());
  if (found < 0) {
    const std::string nearest = nearest_name(ChoiceNames<Statistic>::names, words.front());
    std::string all;
    for (const std::string_view name : ChoiceNames<Statistic>::names)
      all += (all.empty() ? "must be one of " : ", ") + std::string(name);
    throw std::invalid_argument(wish + (nearest.empty() ? all + ", and a column" : "did you mean " + nearest + "?"));
  }
  Aggregate aggregate{static_cast<Statistic>(found)};
  if (words.size() > 2) throw std::invalid_argument(wish + "must be a statistic and one column, as in mean approach");
  if (words.size() == 2) aggregate.column = words[1];
  if (words.size() == 1 && aggregate.statistic != Statistic::count)
    throw std::invalid_argument(wish + "needs a column, as in " + words.front() + " rolling_resistance");
  return aggregate;
}

Table run_group_query(const Database& database, const GroupQuery& query) {
  return naming(database.name(), [&] {
    SQLite::Database& connection = database.connection();
    add_functions(connection);
    const bool with_study = any_of_study(query.filters) || std::any_of(query.by.begin(), query.by.end(), of_study) ||
                            std::any_of(query.aggregates.begin(), query.aggregates.end(),
                                        [](const Aggregate& aggregate) { return of_study(aggregate.column); });
    const std::string view = with_study ? "result" : "evaluation";
    const Columns known = columns_of(connection, view);

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

}  // namespace rollres
