#pragma once

/// Tables of stored results as people read them: for each column one unit with a decimal prefix, in its heading, five
/// digits, temperatures in degrees Celsius. The same numbers stand in reports.

#include <optional>
#include <string>
#include <vector>

#include "db/queries/query.hpp"
#include "db/rows/schema.hpp"
#include "studies/scene_io/formula.hpp"

namespace rollres {

enum class ShownUnits { scaled, scaled_exactly, si };

/// What stands in the columns of a table.
struct ShownColumns {
  std::vector<const QuantityColumn*> quantities;  ///< one for each column; nullptr: shown as it is
  /// Of the rows, one for each, or one for all: numbers may be per metre of a cylinder; nothing: not known.
  std::vector<std::optional<Body>> bodies;
};

/// The table with its units. Where a column's unit differs from row to row each cell has its own.
/// @param units  scaled_exactly: with all digits; si: the numbers as they are
Table shown_table(Table table, const ShownColumns& columns, ShownUnits units);

/// The body that a cell of `indenter` names, with what stands in that of `width`.
std::optional<Body> body_in(const Cell& indenter, const Cell& width);

/// Answers a question for people: as run_query, shown.
/// @param formulas  of the columns that are none of the store
/// @param headings  of the columns, in place of their names
Table shown_rows(const Database& database, Query query, const FormulaDefinitions& formulas, ShownUnits units,
                 const std::vector<std::string>& headings = {});
/// The same of groups.
Table shown_groups(const Database& database, const GroupQuery& query, const FormulaDefinitions& formulas,
                   ShownUnits units);

/// Inputs, and numbers of designs, that differ among the rows that a question asks for, in the order of the lists.
std::vector<std::string> varied_columns(const Database& database, const Query& query);

/// Drops columns, the last named first, until no line of the table is longer than `width` letters. Returns the dropped
/// ones that were there. @param droppable  headings or keys that headings begin with
std::vector<std::string> fit_to_width(Table& table, std::size_t width, const std::vector<std::string>& droppable);

}  // namespace rollres
