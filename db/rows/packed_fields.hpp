#pragma once

/// The fields of a solution as bytes, compressed, for the table fields. Every bit of every number returns.
///
/// Format 1, inside a zlib stream (RFC 1950), little-endian and without gaps:
///
///     float64 spacing_x, spacing_y, origin_x, origin_y
///     int32   first_column, first_row, columns, rows
///     int32   present             bit k: array k follows
///     float64 arrays of columns * rows values, x running fastest, of those present, in the order
///             u, v, w, pressure, shear_x, shear_y, slip_x, slip_y (solution.hpp)
///     int8    zone                columns * rows values: 0 free, 1 stick, 2 slip

#include <string>
#include <string_view>

#include "core/scene/solution.hpp"

namespace rollres {

inline constexpr int fields_format = 1;

std::string packed(const SurfaceFields& fields);

/// @throws std::runtime_error if the format is not known or the bytes are damaged
SurfaceFields unpacked_fields(int format, std::string_view bytes);

}  // namespace rollres
