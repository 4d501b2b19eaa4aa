#pragma once

/// Tables of measured values: CSV with a line of names, each with its unit: "speed [km/h],rolling_resistance [N/m]".
/// Names and units may stand as instruments write them (table_heading.hpp), units also in a line of their own below the
/// names. Tabs, semicolons or commas separate cells, the first of these that the line of names has, or what a line
/// "sep=;" says; numbers have decimal points, or all of them commas. Double quotes may enclose a cell, empty lines and
/// lines that begin with # are left out, as are the names where they are repeated above a further block, and what
/// stands between the blocks. The names stand in the first line that has two which instruments give (is_measured_name)
/// and no number, and what is above it is passed over; else in the first line. Texts are UTF-8, or as spreadsheets of
/// Windows write them.

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/quantity.hpp"

namespace rollres {

struct MeasuredColumn {
  std::string name, unit;           ///< unit empty if none is given
  std::vector<std::string> cells;   ///< without blanks around them
  std::vector<double> values = {};  ///< in place of cells where they were computed [unit, of SI]
  std::string written = {};         ///< the name in the file where that is another
};

struct MeasuredTable {
  std::string file;
  std::string text;  ///< of the whole file
  std::vector<MeasuredColumn> columns;
  std::vector<int> lines;  ///< where each row stands in the file
  int line_of_names = 0;   ///< where the names stand
  int passed_over = 0;     ///< lines above and between that are no part of the table
  bool decimal_commas = false;

  std::size_t rows() const { return lines.size(); }
  /// The column of that name, or nullptr.
  const MeasuredColumn* find(std::string_view name) const;
  /// @throws std::invalid_argument if there is none of that name, or one that is not `known`
  const MeasuredColumn& needed(std::string_view name) const;
  void refuse_others(std::span<const std::string_view> known) const;
  /// The same in one message for all columns. @param known_beside  of each column, the names known where it stands
  /// @param otherwise  what to do where no known name is near
  void refuse_others(const std::function<std::vector<std::string_view>(const MeasuredColumn&)>& known_beside,
                     const std::string& otherwise) const;
  /// Drops columns. @throws std::invalid_argument if there is none of such a name
  void leave_out(std::span<const std::string> names);
  /// Drops columns that are not `known`, and returns their names. @throws std::invalid_argument if one resembles a
  /// known one: it is misspelt
  std::vector<std::string> leave_out_others(std::span<const std::string_view> known);
  /// "data.csv, line 7"
  std::string place(std::size_t row) const;
  /// What was understood: "dma.csv: 12 rows of frequency [Hz] (Frequenz), ...; names in line 9, 8 lines passed over".
  std::string in_words() const;
};

/// @throws std::invalid_argument naming file and line: no row, a row with more or fewer cells than names, a quote that
///         does not end, a name given twice
/// @throws std::runtime_error if the file cannot be read
MeasuredTable read_measured_table(const std::filesystem::path& file);

/// The number in a cell in SI units.
/// @param unit      the wanted SI unit; "1" if dimensionless, "K" for a temperature, which may be given in degC
/// @throws std::invalid_argument naming file, line, column, cell and rule: an empty cell, text in a number, a wrong
/// unit
double measured_number(const MeasuredTable& table, const MeasuredColumn& column, std::size_t row,
                       std::string_view unit);

/// The numbers of a column, all within a range. @param rule  in place of the range's own
std::vector<double> measured_numbers(const MeasuredTable& table, const MeasuredColumn& column, std::string_view unit,
                                     const Range& range, const std::string& rule = {});

/// A column's name as the file writes it.
std::string name_in_file(const MeasuredColumn& column);

/// A column's name with its unit: "speed [km/h]".
std::string heading(const MeasuredColumn& column);

}  // namespace rollres
