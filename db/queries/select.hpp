#pragma once

/// What the questions of query.hpp have in common on their way to SQL.

#include <cstddef>
#include <string>
#include <vector>

#include "db/file/sqlite.hpp"
#include "db/queries/query.hpp"
#include "db/rows/schema.hpp"

namespace rollres {

using Columns = std::vector<Column>;

/// The columns of a view, with those of quantities that an older file, read as it is, does not have: nothing stands
/// there.
Columns known_columns(SQLite::Database& connection, const std::string& view);

/// A column of `columns`, or an input of the further layers that one of them holds.
/// @throws std::invalid_argument naming the unknown column and the nearest known one
const Column& column_named(const Columns& columns, const std::string& name);

bool has_column(const Columns& columns, const std::string& name);

/// Whether a column is one of the view result only.
bool of_study(const std::string& column);
bool any_of_study(const std::vector<Filter>& filters);

/// How many studies are named, each by a filter study=NAME.
std::ptrdiff_t studies_named(const std::vector<Filter>& filters);

/// " WHERE ...", or nothing; appends what it binds.
std::string where_clause(const std::vector<Filter>& filters, const Columns& known, std::vector<Cell>& bound);

/// A column to sort by: "-speed" is speed from large to small.
struct SortKey {
  explicit SortKey(const std::string& text);
  std::string column;
  bool falling = false;
};

/// "speed DESC NULLS LAST, ", one for each key; `known` are the columns that may be named.
std::string order_terms(const std::vector<std::string>& sort, const Columns& known);

/// " LIMIT ?", with " OFFSET ?" where rows are left out before, or nothing; appends what it binds.
/// @throws std::invalid_argument if it is negative
std::string limit_clause(const std::optional<std::int64_t>& limit, std::vector<Cell>& bound, std::int64_t offset = 0);

/// All rows of a statement, with what it binds, under its own names of columns.
Table rows_of(SQLite::Database& connection, const std::string& sql, const std::vector<Cell>& bound);
ColumnTable columns_of_rows(SQLite::Database& connection, const std::string& sql, const std::vector<Cell>& bound);

/// Makes computed columns known: each is a function of its own, to which the connection holds on.
/// @throws std::invalid_argument as column_named
void add_computed(SQLite::Database& connection, const std::vector<ComputedColumn>& computed, Columns& known);

/// Gives a connection what SQLite lacks: the aggregates median(x) and stddev(x) (of a sample, over n - 1; NULL for
/// fewer than two), which leave NULL out, and rounded(x), x to 12 significant digits, by which numbers are told apart.
void add_functions(SQLite::Database& connection);

}  // namespace rollres
