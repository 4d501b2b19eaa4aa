#pragma once

/// A scene and its solution as a row of the table evaluation: the one place where values become SQL and return.
/// Every bit of a number returns but the sign of zero; a warning is one line.

#include <string>

#include "core/scene/scene.hpp"
#include "core/scene/solution.hpp"
#include "db/file/sqlite.hpp"

namespace rollres {

/// Binds inputs and outputs, in the order of quantity_columns(), to parameters from `first` on.
void bind_row(SQLite::Statement& statement, int first, const RollingScene& scene, const RollingSolution& solution);

struct SceneAndSolution {
  RollingScene scene;
  RollingSolution solution;
};

/// Reads inputs and outputs, in the order of quantity_columns(), from columns `first` on. NULL leaves a default as it
/// is.
/// @throws std::runtime_error if a choice has a name that this version does not know
SceneAndSolution read_row(SQLite::Statement& statement, int first);

/// The columns of quantity_columns() as a list for SELECT, "NULL" for those that the file does not have.
std::string select_list(SQLite::Database& connection);

}  // namespace rollres
