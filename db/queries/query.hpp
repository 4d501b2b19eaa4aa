#pragma once

/// Questions to the store: rows of evaluation, or of the view result where a study or a position is asked for; groups
/// of them; and SQL.
///
/// Names of columns are compared with those of the file, values are bound: nothing that a user writes becomes SQL, but
/// in run_sql, which only reads.

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/quantity.hpp"
#include "db/file/database.hpp"
#include "db/queries/column_table.hpp"

namespace rollres {

enum class Comparison { equal, not_equal, less, less_or_equal, greater, greater_or_equal, contains };

/// A condition on one column. Numbers that differ by no more than the slack are equal, others are less or greater;
/// "infinite" is a number. An empty value stands for what is absent: "half_width=" and "half_width!=".
struct Filter {
  std::string column;
  Comparison comparison = Comparison::equal;
  std::string value;
  double slack = 1e-12;  ///< relative to the value [1]
  /// Whether the value has the unit of a metre of a cylinder (N/m), or that of a whole body (N): other rows differ from
  /// it, whatever their number. Nothing if no unit tells.
  std::optional<bool> per_metre = {};

  bool operator==(const Filter&) const = default;
};

/// By how much a number can differ from one that people wrote or copied from a table: half a unit of its last digit, or
/// of its fifth if it has fewer, as tables show no less; relative, and never below 1e-12. 0 if there is no number.
/// @param text begins with the number
double slack_of_written(std::string_view text);

/// Reads "speed>0.1", "status!=converged", "reason~friction" (contains); operators = != < <= > >= ~. Numbers have the
/// slack of written ones.
/// @throws std::invalid_argument if there is no operator, or no column before it
Filter parse_filter(std::string_view text);

/// A column that is computed from others of its row. Its name must be that of no other column.
struct ComputedColumn {
  std::string name;
  std::vector<std::string> of;                                       ///< columns that are numbers
  std::function<double(std::span<const double> values)> value = {};  ///< NaN: absent; so is what is given to it
};

struct Query {
  std::vector<Filter> filters = {};       ///< all of them hold; of several studies that are named, one
  std::vector<std::string> columns = {};  ///< empty: all
  std::vector<std::string> sort = {};     ///< "-speed": from large to small; the first counts most, absent ones last
  std::optional<std::int64_t> limit = {};
  std::int64_t offset = 0;                    ///< so many rows are left out before; with a limit only
  std::vector<ComputedColumn> computed = {};  ///< which the others may name
};

/// Reads the whole answer at once, so that no reader holds up a writer.
/// @throws std::invalid_argument naming an unknown column and the nearest known one, or a value that is no number
/// @throws std::runtime_error naming the file if the database fails
Table run_query(const Database& database, const Query& query);
/// The same by columns, for answers of many rows.
ColumnTable run_column_query(const Database& database, const Query& query);

/// Whether each of the columns of a question holds more than one value in its rows, an absent one counted.
/// @throws as run_query
std::vector<bool> columns_that_vary(const Database& database, const Query& query);

enum class Statistic { count, min, max, mean, median, stddev, sum };
template <>
struct ChoiceNames<Statistic> {
  static constexpr std::array<std::string_view, 7> names{"count", "min", "max", "mean", "median", "stddev", "sum"};
};

/// A number that stands for many rows. Absent values do not count; stddev is that of a sample, over n - 1.
struct Aggregate {
  Statistic statistic = Statistic::count;
  std::string column = {};  ///< a number; empty for the count of rows
  std::string weight = {};  ///< of a mean or a sum: a number by which each row counts; empty: all alike

  std::string name() const;  ///< as a column: "mean_approach", "mean_approach_weighted", "count"
};

/// Reads "mean approach", "mean approach weighted share", "count".
/// @throws std::invalid_argument naming an unknown statistic and the nearest known one, or a missing column
Aggregate parse_aggregate(std::string_view text);

struct GroupQuery {
  std::vector<Filter> filters = {};        ///< all of them hold
  std::vector<Aggregate> aggregates = {};  ///< of each group
  std::vector<std::string> by = {};        ///< columns that are equal, to 12 digits, inside a group; empty: one group
  std::vector<std::string> sort = {};      ///< of `by` and names of aggregates; what is not named: by `by`, rising
  std::optional<std::int64_t> limit = {};
  std::vector<ComputedColumn> computed = {};  ///< as in Query
};

/// One row for each group that is not empty: the columns of `by`, then the aggregates.
/// @throws as run_query
Table run_group_query(const Database& database, const GroupQuery& query);

/// The answer to one statement of SQLite's SQL that only reads. Knows the aggregate functions median and stddev.
/// @throws std::invalid_argument if it is no statement, more than one, wrong, or could write
/// @throws std::runtime_error naming the file if the database fails
Table run_sql(const Database& database, const std::string& sql);

}  // namespace rollres
