#pragma once

/// Tables of stored results as text.

#include <iosfwd>
#include <string>

#include "db/query.hpp"

namespace rollres {

/// Aligned columns under their names, six digits; "-" where something is absent.
void write_aligned(std::ostream& out, const Table& table);

/// RFC 4180 with a line of names; all digits; empty where something is absent, "inf" for an infinite number.
void write_csv(std::ostream& out, const Table& table);

/// An array with one object for each row; all digits; null where something is absent, "infinite" for an infinite
/// number.
void write_json(std::ostream& out, const Table& table);

}  // namespace rollres
