#pragma once

#include <string>

#include "db/rows/result_store.hpp"

namespace rollres {

/// The study that a command means: the one of this name or, with no name, the only one.
/// @throws std::invalid_argument naming the file: it holds no study, several (with their names), or none of that name
///         (with the nearest one)
/// @throws std::runtime_error naming the file if the database fails
StudySummary stored_study(ResultStore& store, const std::string& name);

}  // namespace rollres
