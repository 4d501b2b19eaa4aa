#include "studies/text/measured_table.hpp"

#include <stdexcept>

#include "studies/text/readable_number.hpp"
#include "studies/text/units.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

[[noreturn]] void fail(const std::string& place, const std::string& rule) {
  throw std::invalid_argument(place + ": " + rule);
}

/// "-40 to 60 degC" of a table that has temperatures.
std::string temperatures_of(const MeasuredTable& table) {
  const MeasuredColumn* const column = table.find("temperature");
  if (!column || column->unit.empty()) return "";
  const std::vector<double> all = measured_numbers(table, *column, "K", {});
  const auto [coldest, warmest] = minmax_element(all);
  const std::string from = short_number(celsius().number(*coldest), 4);
  return "; at " + from + (*coldest < *warmest ? " to " + short_number(celsius().number(*warmest), 4) : "") + " degC";
}

}  // namespace

std::string MeasuredTable::in_words() const {
  std::string names;
  for (const MeasuredColumn& column : columns)
    names += (names.empty() ? "" : ", ") + column.name + (column.unit.empty() ? "" : " [" + column.unit + "]") +
             (column.written.empty() ? "" : " (" + column.written + ")");
  return std::filesystem::path(file).filename().string() + ": " + std::to_string(rows()) + " rows of " + names +
         "; names in line " + std::to_string(line_of_names) +
         (passed_over > 0 ? ", lines passed over: " + std::to_string(passed_over) : "") +
         (decimal_commas ? "; decimal commas" : "") + temperatures_of(*this);
}

const MeasuredColumn* MeasuredTable::find(std::string_view name) const {
  const auto found = find_if(columns, [&](const MeasuredColumn& column) { return column.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

const MeasuredColumn& MeasuredTable::needed(std::string_view name) const {
  if (const MeasuredColumn* const column = find(name)) return *column;
  throw std::invalid_argument(file + ": has no column " + std::string(name));
}

void MeasuredTable::refuse_others(std::span<const std::string_view> known) const {
  refuse_others([&](const MeasuredColumn&) { return std::vector<std::string_view>(known.begin(), known.end()); },
                "known are " + joined(known) + "; ignore_columns leaves others out");
}

void MeasuredTable::refuse_others(
    const std::function<std::vector<std::string_view>(const MeasuredColumn&)>& known_beside,
    const std::string& otherwise) const {
  std::string bad;
  bool strange = false;  // a name that resembles none
  for (const MeasuredColumn& column : columns)
    if (const std::vector<std::string_view> known = known_beside(column); find_name(known, column.name) < 0) {
      const std::string words = unknown("unknown column", known, column.name);
      strange = strange || !words.ends_with('?');
      bad += (bad.empty() ? "" : "; ") + name_in_file(column) + ": " + words;
    }
  if (!bad.empty()) fail(file, bad + (strange && !otherwise.empty() ? "; " + otherwise : ""));
}

void MeasuredTable::leave_out(std::span<const std::string> names) {
  for (const std::string& name : names)
    if (std::erase_if(columns,
                      [&](const MeasuredColumn& column) { return column.name == name || column.written == name; }) == 0)
      fail(file, "ignore_columns: " + name + ": the table has no such column");
}

std::vector<std::string> MeasuredTable::leave_out_others(std::span<const std::string_view> known) {
  std::vector<std::string> others;
  for (const MeasuredColumn& column : columns) {
    if (find_name(known, column.name) >= 0) continue;
    if (!nearest_name(known, column.name).empty()) refuse_others(known);
    others.push_back(name_in_file(column));
  }
  leave_out(others);
  return others;
}

std::string MeasuredTable::place(std::size_t row) const { return file + ", line " + std::to_string(lines.at(row)); }

std::string name_in_file(const MeasuredColumn& column) { return column.written.empty() ? column.name : column.written; }

std::string heading(const MeasuredColumn& column) {
  const std::string name = name_in_file(column);
  return column.unit.empty() ? name : name + " [" + column.unit + "]";
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
