#pragma once

/// Functions of SQL that SQLite lacks.

#include "db/file/sqlite.hpp"

namespace rollres {

/// Gives a connection what SQLite lacks: the aggregates median(x) and stddev(x) (of a sample, over n - 1; NULL for
/// fewer than two), which leave NULL out, and rounded(x), x to 12 significant digits, by which numbers are told apart.
void add_functions(SQLite::Database& connection);

}  // namespace rollres
