#pragma once

/// Stored results as JSON. For sources only: it needs nlohmann_json.

#include <array>
#include <span>
#include <string>
#include <type_traits>
#include <utility>

#include "db/file/provenance.hpp"
#include "db/queries/table.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

/// null for what is absent, "infinite" for an infinite number.
Json json_of(const Cell& cell);

/// null for what is not finite.
Json finite_or_null(double value);

/// null for a number that is not finite and for what is absent.
template <class Value>
Json json_value(Value&& value) {
  using Plain = std::remove_cvref_t<Value>;
  if constexpr (std::is_same_v<Plain, double>)
    return finite_or_null(value);
  else if constexpr (requires { value.has_value(); })
    return value ? json_value(*value) : Json();
  else
    return Json(std::forward<Value>(value));
}

/// An object of keys and values by turns.
Json json_of_pairs(std::span<Json> parts);
/// The same, its values as json_value makes them: json_object("load", 20.0, "speed", 0.5).
template <class... Parts>
Json json_object(Parts&&... keys_and_values) {
  std::array<Json, sizeof...(Parts)> parts{json_value(std::forward<Parts>(keys_and_values))...};
  return json_of_pairs(parts);
}

/// An array with one object for each row.
Json json_of(const Table& table);

/// What computed a result.
Json json_of(const Provenance& program);

/// JSON as text, indented by so many blanks, or on one line if `indent` is -1. What is not UTF-8 is replaced.
std::string text_of(const Json& json, int indent);

}  // namespace rollres
