#pragma once

/// A study before it runs, as a table: what `rollres plan` prints.

#include <cstddef>
#include <limits>
#include <vector>

#include "db/queries/table.hpp"
#include "db/rows/result_store.hpp"
#include "studies/study/study.hpp"

namespace rollres {

/// How many points of a study a database has.
struct StoredPoints {
  std::size_t answered = 0, failed = 0;
};

/// The status of each point in the database, whichever study asked for it; absent where it is not stored.
/// @throws std::runtime_error naming the file if the database fails
std::vector<Cell> stored_status(ResultStore& store, const StudyPlan& plan);

StoredPoints count_stored(const std::vector<Cell>& status);

/// One row for each of the first `limit` points: position, the inputs that vary [SI], and the status if it is asked for
/// (empty `status`: it is not).
Table plan_table(const Study& study, const StudyPlan& plan, const std::vector<Cell>& status,
                 std::size_t limit = std::numeric_limits<std::size_t>::max());

}  // namespace rollres
