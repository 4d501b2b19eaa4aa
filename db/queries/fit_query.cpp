#include "db/queries/fit_query.hpp"

#include <map>
#include <stdexcept>

#include "core/messages/message_text.hpp"
#include "db/queries/select.hpp"

namespace rollres {

namespace {

/// What the table of parameters says of one of a fit.
std::string of_parameter(const std::string& name, const std::string& value) {
  return "(SELECT " + value +
         " FROM fit_parameter WHERE fit_parameter.fit = fit.id AND fit_parameter.name = " + quoted_text(name) + ")";
}

std::string end_of_interval(const std::string& end) {
  return "CASE profile_" + end.substr(0, end == "lowest" ? 3 : 4) + " WHEN '' THEN linear_" + end + " ELSE profile_" +
         end + " END";
}

Columns own_columns(const Database& database) {
  Columns columns = columns_of(database.connection(), "fit");
  columns.push_back({"parameters", "TEXT",
                     "(SELECT group_concat(name, ', ') FROM (SELECT name FROM fit_parameter WHERE fit_parameter.fit = "
                     "fit.id AND NOT fixed ORDER BY position))"});
  columns.push_back({"values", "INTEGER", "(SELECT count(*) FROM fit_data WHERE fit_data.fit = fit.id)"});
  return columns;
}

Columns all_columns(const Database& database) {
  Columns columns = own_columns(database);
  for (const StoredParameter& one : fitted_parameters(database)) {
    const std::array<std::string, parameter_columns.size()> values{"value", "standard_error", end_of_interval("lowest"),
                                                                   end_of_interval("highest")};
    for (std::size_t i = 0; i < values.size(); ++i)
      columns.push_back({one.name + std::string(parameter_columns[i]), "REAL", of_parameter(one.name, values[i])});
  }
  return columns;
}

/// Names of columns without the texts of files and the axes of curves, what tells fits apart first.
std::vector<std::string> usual_columns(const Columns& columns) {
  constexpr std::array<std::string_view, 13> left_out{
      "model",  "stopped",       "output_unit",   "definition", "data_digest", "scene",   "x_name",
      "x_unit", "x_logarithmic", "y_logarithmic", "y_name",     "y_unit",      "git_hash"};
  std::vector<std::string> names{"id", "name", "kind", "status", "parameters", "values"};
  for (const Column& column : columns)
    if (find_name(left_out, column.name) < 0 && !contains(names, column.name)) names.push_back(column.name);
  return names;
}

/// Puts the parameters of fits into the columns of their names. @param table  whose rows begin with the id of their
/// fit, which is taken out
void fill_parameters(const Database& database, Table& table) {
  std::multimap<std::string, std::size_t> places;
  for (std::size_t i = 0; i < table.columns.size(); ++i) places.emplace(table.columns[i], i);
  std::map<Cell, std::vector<Cell>*> rows;
  for (std::vector<Cell>& row : table.rows) {
    rows.emplace(row.front(), &row);
    row.erase(row.begin());
  }
  const std::string select = "SELECT fit, name, value, standard_error, " + end_of_interval("lowest") + ", " +
                             end_of_interval("highest") + " FROM fit_parameter";
  for (const std::vector<Cell>& one : rows_of(database.connection(), select, {}).rows) {
    const auto row = rows.find(one[0]);
    if (row == rows.end()) continue;
    for (std::size_t part = 0; part < parameter_columns.size(); ++part) {
      const auto [first, last] =
          places.equal_range(std::get<std::string>(one[1]) + std::string(parameter_columns[part]));
      for (auto place = first; place != last; ++place) (*row->second)[place->second] = one[2 + part];
    }
  }
}

/// Refuses what no fit has.
void refuse_unknown(const Database& database, const Query& query, const Columns& known) {
  std::vector<std::string_view> names;
  for (const Column& column : known) names.push_back(column.name);
  const auto check = [&](const std::string& name) {
    if (find_name(names, name) >= 0) return;
    std::string rule = "did you mean " + nearest_name(names, name) + "?";
    if (nearest_name(names, name).empty()) {
      rule = "there are " + joined(usual_columns(own_columns(database)));
      for (const StoredParameter& one : fitted_parameters(database)) rule += ", " + one.name;
    }
    throw std::invalid_argument(name + ": unknown column of fits; " + rule);
  };
  for (const Filter& filter : query.filters) check(filter.column);
  for (const std::string& name : query.columns) check(name);
  for (const std::string& name : query.sort) check(SortKey(name).column);
}

}  // namespace

std::vector<StoredParameter> fitted_parameters(const Database& database) {
  return naming(database.name(), [&] {
    std::vector<StoredParameter> parameters;
    for (const auto& row : rows_of(database.connection(),
                                   "SELECT name, CASE WHEN min(unit) = max(unit) THEN min(unit) ELSE '' END FROM "
                                   "fit_parameter WHERE NOT fixed GROUP BY name ORDER BY name",
                                   {})
                               .rows)
      parameters.push_back({std::get<std::string>(row[0]), std::get<std::string>(row[1])});
    return parameters;
  });
}

std::vector<std::string> usual_fit_columns(const Database& database) {
  return naming(database.name(), [&] { return usual_columns(all_columns(database)); });
}

Table run_fit_query(const Database& database, const Query& query) {
  return naming(database.name(), [&] {
    const Columns known = all_columns(database);
    refuse_unknown(database, query, known);
    Table table;
    table.columns = query.columns.empty() ? usual_fit_columns(database) : query.columns;
    // Hundreds of parameters would be more columns than SQL knows: only what is the fit's own is selected.
    std::string select = "fit.id";
    const Columns own = own_columns(database);
    for (const std::string& name : table.columns)
      select += ", " + (has_column(own, name) ? column_named(own, name).sql() : "NULL");
    std::vector<Cell> bound;
    const std::string where = where_clause(query.filters, known, bound), order = order_terms(query.sort, known);
    const std::string limit = limit_clause(query.limit, bound);
    table.rows =
        rows_of(database.connection(),
                "SELECT " + select + " FROM fit" + where + " ORDER BY " + order + "fit.name, fit.id" + limit, bound)
            .rows;
    fill_parameters(database, table);
    return table;
  });
}

}  // namespace rollres
