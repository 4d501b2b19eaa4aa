#pragma once

/// Stored results as JSON. For sources only: it needs nlohmann_json.

#include <string>

#include "db/file/provenance.hpp"
#include "db/queries/table.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

/// null for what is absent, "infinite" for an infinite number.
Json json_of(const Cell& cell);

/// null for what is not finite.
Json finite_or_null(double value);

/// An array with one object for each row.
Json json_of(const Table& table);

/// What computed a result.
Json json_of(const Provenance& program);

/// JSON as text, indented by so many blanks, or on one line if `indent` is -1. What is not UTF-8 is replaced.
std::string text_of(const Json& json, int indent);

}  // namespace rollres
