#pragma once

/// A table as a plain value: what questions to a database answer, and what is printed of them.

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace rollres {

/// Absent, a count, a number or a text.
using Cell = std::variant<std::monostate, std::int64_t, double, std::string>;

/// A count or a number; nothing of an absent cell or a text.
inline std::optional<double> number_in(const Cell& cell) {
  if (const auto* const count = std::get_if<std::int64_t>(&cell)) return static_cast<double>(*count);
  if (const auto* const number = std::get_if<double>(&cell)) return *number;
  return std::nullopt;
}

struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<Cell>> rows;
};

}  // namespace rollres
