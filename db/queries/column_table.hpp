#pragma once

/// A table by its columns, for answers of many rows and columns most of which say the same in all rows: such a column
/// takes the room of one cell, one of numbers eight bytes a row.

#include <cstddef>
#include <string>
#include <vector>

#include "db/queries/table.hpp"

namespace rollres {

class CellColumn {
 public:
  void add(Cell cell);
  Cell operator[](std::size_t row) const;
  double number(std::size_t row) const;  ///< NaN where there is none
  /// Whether all rows hold what the first one does.
  bool uniform() const { return numbers_.empty() && cells_.empty(); }
  /// Each cell once, in order.
  std::vector<Cell> values() const;

 private:
  std::size_t size_ = 0;
  Cell first_;                   // while all are alike
  std::vector<double> numbers_;  // NaN: absent
  std::vector<Cell> cells_;      // where counts or texts are among them
};

struct ColumnTable {
  std::vector<std::string> names;
  std::vector<CellColumn> columns;
  std::size_t rows = 0;
};

}  // namespace rollres
