#include "studies/text/measured_table.hpp"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "studies/text/files.hpp"
#include "studies/text/strict_json.hpp"
#include "studies/text/units.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

[[noreturn]] void fail(const std::string& place, const std::string& rule) {
  throw std::invalid_argument(place + ": " + rule);
}

std::string line_place(const std::string& file, int line) { return file + ", line " + std::to_string(line); }

/// The cells of a line. Quotes may enclose separators; two quotes inside stand for one.
std::vector<std::string> cells_of(const std::string& line, char separator, const std::string& place) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char letter = line[i];
    if (letter == '"') {
      if (quoted && i + 1 < line.size() && line[i + 1] == '"') {
        cells.back() += '"';
        ++i;
      } else {
        quoted = !quoted;
      }
    } else if (letter == separator && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += letter;
    }
  }
  if (quoted) fail(place, "a quote does not end on this line");
  for (std::string& cell : cells) cell = trimmed(cell);
  return cells;
}

MeasuredColumn column_of(const std::string& name, const std::string& place) {
  const auto layer = name.find("].");  // of coating_layers[0].layer_thickness [mm]
  const auto open = name.find('[', layer == std::string::npos ? 0 : layer);
  if (open == std::string::npos) {
    if (name.empty()) fail(place, "a column has no name");
    return {name, "", {}};
  }
  if (name.back() != ']')
    fail(place, "\"" + shortened(name) + "\": must be a name with its unit in brackets: \"speed [m/s]\"");
  MeasuredColumn column{std::string(trimmed(name.substr(0, open))),
                        std::string(trimmed(name.substr(open + 1, name.size() - open - 2))),
                        {}};
  if (column.name.empty()) fail(place, "\"" + shortened(name) + "\": a column has no name");
  return column;
}

char separator_of(const std::string& names) {
  for (const char separator : {',', ';', '\t'})
    if (names.find(separator) != std::string::npos) return separator;
  return ',';
}

}  // namespace

const MeasuredColumn* MeasuredTable::find(std::string_view name) const {
  const auto found =
      std::find_if(columns.begin(), columns.end(), [&](const MeasuredColumn& column) { return column.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

const MeasuredColumn& MeasuredTable::needed(std::string_view name) const {
  if (const MeasuredColumn* const column = find(name)) return *column;
  throw std::invalid_argument(file + ": has no column " + std::string(name));
}

void MeasuredTable::refuse_others(std::span<const std::string_view> known) const {
  for (const MeasuredColumn& column : columns)
    if (find_name(known, column.name) < 0)
      fail(file, column.name + ": " +
                     unknown("unknown column", known, column.name,
                             "known are " + joined(known) + "; ignore_columns leaves others out"));
}

void MeasuredTable::leave_out(std::span<const std::string> names) {
  for (const std::string& name : names)
    if (std::erase_if(columns, [&](const MeasuredColumn& column) { return column.name == name; }) == 0)
      fail(file, "ignore_columns: " + name + ": the table has no such column");
}

std::vector<std::string> MeasuredTable::leave_out_others(std::span<const std::string_view> known) {
  std::vector<std::string> others;
  for (const MeasuredColumn& column : columns) {
    if (find_name(known, column.name) >= 0) continue;
    if (!nearest_name(known, column.name).empty()) refuse_others(known);
    others.push_back(column.name);
  }
  leave_out(others);
  return others;
}

std::string MeasuredTable::place(std::size_t row) const { return line_place(file, lines.at(row)); }

std::string heading(const MeasuredColumn& column) {
  const std::string& name = column.written.empty() ? column.name : column.written;
  return column.unit.empty() ? name : name + " [" + column.unit + "]";
}

MeasuredTable read_measured_table(const std::filesystem::path& file) {
  constexpr std::size_t largest = 100'000'000;  // of measured values
  MeasuredTable table{file.string(), whole_file(file, largest), {}, {}};
  if (table.text.empty()) throw std::runtime_error(table.file + ": cannot be read or is empty");
  std::istringstream lines(table.text.starts_with("\xEF\xBB\xBF") ? table.text.substr(3) : table.text);
  char separator = ',';
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    const std::string place = line_place(table.file, ++number);
    if (line.find('\0') != std::string::npos) fail(place, "has a NUL character");
    const std::string content(trimmed(line));
    if (content.empty() || content.front() == '#') continue;
    if (table.columns.empty()) {
      separator = separator_of(content);
      for (const std::string& name : cells_of(content, separator, place)) {
        MeasuredColumn column = column_of(name, place);
        if (table.find(column.name)) fail(place, "\"" + shortened(column.name) + "\": column given twice");
        table.columns.push_back(std::move(column));
      }
      continue;
    }
    const std::vector<std::string> cells = cells_of(line, separator, place);
    if (cells.size() != table.columns.size())
      fail(place, std::to_string(cells.size()) + " cells where the first line names " +
                      std::to_string(table.columns.size()) + " columns");
    for (std::size_t i = 0; i < cells.size(); ++i) table.columns[i].cells.push_back(cells[i]);
    table.lines.push_back(number);
  }
  if (table.lines.empty()) fail(table.file, "has no row of measured values");
  return table;
}

double measured_number(const MeasuredTable& table, const MeasuredColumn& column, std::size_t row,
                       std::string_view unit) {
  if (!column.values.empty()) return column.values[row];
  const std::string& cell = column.cells.at(row);
  const std::string place = table.place(row);
  if (cell.empty()) fail(place, heading(column) + " is missing");
  const auto plain = plain_number(cell);
  if (!plain) fail(place, heading(column) + " = " + shortened(cell) + ": must be a finite number");
  if (column.unit.empty() || column.unit == "1") {
    if (unit != "1") fail(place, heading(column) + ": the first line must name " + unit_in_words(unit));
    return *plain;
  }
  try {
    const bool inverse = unit == "1/Pa" && column.unit.starts_with("1/");  // behind a number this reads as another one
    const std::string with_unit = cell + " " + (inverse ? "(" + column.unit.substr(2) + ")^-1" : column.unit);
    return unit == "K" ? kelvin(with_unit) : si_value(with_unit, unit);
  } catch (const std::invalid_argument& error) {
    fail(place, heading(column) + ": " + error.what());
  }
}

std::vector<double> measured_numbers(const MeasuredTable& table, const MeasuredColumn& column, std::string_view unit,
                                     const Range& range, const std::string& rule) {
  std::vector<double> numbers;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    numbers.push_back(measured_number(table, column, row, unit));
    if (!range.contains(numbers.back()))
      fail(table.place(row),
           heading(column) + " = " + shortened(column.cells[row]) + ": " + (rule.empty() ? range.rule() : rule));
  }
  return numbers;
}

}  // namespace rollres
