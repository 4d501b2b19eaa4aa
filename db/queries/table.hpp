#pragma once

/// A table as a plain value: what questions to a database answer, and what is printed of them.

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace rollres {

/// Absent, a count, a number or a text.
using Cell = std::variant<std::monostate, std::int64_t, double, std::string>;

struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<Cell>> rows;
};

}  // namespace rollres
