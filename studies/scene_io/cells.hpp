#pragma once

/// Values of scenes and solutions as cells of a table: [SI], names for choices; what is absent (NaN, not given, an
/// empty list) is an absent cell.

#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/scene/solution.hpp"
#include "db/queries/table.hpp"

namespace rollres {

Cell cell_of(double value);
Cell cell_of(const std::optional<double>& value);
Cell cell_of(const std::vector<double>& list);
Cell cell_of(const BondedLayers& layers);
Cell cell_of(const std::string& text);
Cell cell_of(const std::vector<std::string>& lines);
template <class Value>
requires std::is_integral_v<Value> Cell cell_of(Value count) { return static_cast<std::int64_t>(count); }
template <class Choice>
requires std::is_enum_v<Choice> Cell cell_of(Choice choice) { return std::string(name_of(choice)); }

/// The cells of a row, each beside the name of its column.
using NamedCells = std::vector<std::pair<std::string_view, Cell>>;

/// A table with a row for each record. @param row_of the named cells of one; those of a default one name the columns
template <class Record, class RowOf>
Table table_of(const std::vector<Record>& records, const RowOf& row_of) {
  Table table;
  for (const auto& [name, cell] : row_of(Record())) table.columns.emplace_back(name);
  for (const Record& record : records) {
    std::vector<Cell>& row = table.rows.emplace_back();
    for (const auto& [name, cell] : row_of(record)) row.push_back(cell);
  }
  return table;
}

/// One input of a scene.
Cell input_of(const RollingScene& scene, std::string_view key);

/// One output of a solution.
Cell output_of(const RollingSolution& solution, std::string_view key);

/// All inputs under their keys, in the order of input_keys().
NamedCells input_cells(const RollingScene& scene);

}  // namespace rollres
