#pragma once

#include <string>

#include "db/queries/query.hpp"

namespace rollres {

/// Reads a filter as people write it, "load>=20 kN/m": as parse_filter (db/queries/query.hpp), but a value with a unit
/// becomes a number in SI.
/// @throws std::invalid_argument as parse_filter, or naming the value whose unit does not fit the column
Filter read_filter(const std::string& text);

}  // namespace rollres
