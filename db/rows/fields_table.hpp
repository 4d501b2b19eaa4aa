#pragma once

/// The table fields. Its functions throw SQLite::Exception.

#include <optional>
#include <string>

#include "db/file/sqlite.hpp"
#include "db/rows/result_store.hpp"

namespace rollres {

/// False for a file of the first schema that could not be migrated.
bool has_fields_table(SQLite::Database& connection);

/// Stores the fields of an evaluation that is there, in place of those it had.
void put_fields(SQLite::Database& connection, const std::string& key, const SurfaceFields& fields);

/// Stores the fields of an answer that is there already, unless it has some or has another status.
/// @return whether they were stored
bool add_fields(SQLite::Database& connection, const Evaluation& answer);

void remove_fields(SQLite::Database& connection, const std::string& key);

struct PackedFields {
  int format = 0;
  std::string bytes;
};
std::optional<PackedFields> find_packed_fields(SQLite::Database& connection, const std::string& key);

}  // namespace rollres
