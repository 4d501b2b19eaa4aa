#pragma once

/// The table fields: those of a solution as bytes, compressed. Functions of a connection throw SQLite::Exception.

#include <optional>
#include <string>
#include <string_view>

#include "core/scene/solution.hpp"
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

/// Every bit of every number returns from the bytes. Format 1, inside a zlib stream (RFC 1950), little-endian and
/// without gaps:
///
///     float64 spacing_x, spacing_y, origin_x, origin_y
///     int32   first_column, first_row, columns, rows
///     int32   present             bit k: array k follows
///     float64 arrays of columns * rows values, x running fastest, of those present, in the order
///             u, v, w, pressure, shear_x, shear_y, slip_x, slip_y (solution.hpp)
///     int8    zone                columns * rows values: 0 free, 1 stick, 2 slip
inline constexpr int fields_format = 1;

std::string packed(const SurfaceFields& fields);

/// @throws std::runtime_error if the format is not known or the bytes are damaged
SurfaceFields unpacked_fields(int format, std::string_view bytes);

}  // namespace rollres
