#pragma once

/// Questions to the store: rows of evaluation, or of the view result where a study or a position is asked for.
///
/// Names of columns are compared with those of the file, values are bound: nothing that a user writes becomes SQL.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "db/database.hpp"

namespace rollres {

enum class Comparison { equal, not_equal, less, less_or_equal, greater, greater_or_equal, contains };

/// A condition on one column. Numbers are equal when they agree to 12 significant digits, and less or greater when they
/// do not; "infinite" is a number. An empty value stands for what is absent: "half_width=" and "half_width!=".
struct Filter {
  std::string column;
  Comparison comparison = Comparison::equal;
  std::string value;
};

/// Reads "speed>0.1", "status!=converged", "reason~friction" (contains); operators = != < <= > >= ~.
/// @throws std::invalid_argument if there is no operator, or no column before it
Filter parse_filter(std::string_view text);

struct Query {
  std::vector<Filter> filters = {};       ///< all of them hold
  std::vector<std::string> columns = {};  ///< empty: all
  std::vector<std::string> sort =
      {};  ///< columns, the first counts most; "-speed": from large to small; absent ones last
  std::optional<std::int64_t> limit = {};
};

/// Absent, a count, a number or a text.
using Cell = std::variant<std::monostate, std::int64_t, double, std::string>;

struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<Cell>> rows;
};

/// Reads the whole answer at once, so that no reader holds up a writer.
/// @throws std::invalid_argument naming an unknown column and the nearest known one, or a value that is no number
/// @throws std::runtime_error naming the file if the database fails
Table run_query(const Database& database, const Query& query);

}  // namespace rollres
