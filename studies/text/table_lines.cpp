// From the lines of a file to the columns of a table.

#include "studies/text/measured_table.hpp"

#include <algorithm>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "studies/text/files.hpp"
#include "studies/text/strict_json.hpp"
#include "studies/text/table_heading.hpp"
#include "studies/text/units.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

[[noreturn]] void refuse_line(const std::string& place, const std::string& rule) {
  throw std::invalid_argument(place + ": " + rule);
}

std::string line_place(const std::string& file, int line) { return file + ", line " + std::to_string(line); }

std::string without_brackets(const std::string& cell) {
  const bool bracketed =
      cell.size() > 2 && ((cell.front() == '[' && cell.back() == ']') || (cell.front() == '(' && cell.back() == ')'));
  return bracketed ? cell.substr(1, cell.size() - 2) : cell;
}

/// The cells of a line. Quotes may enclose separators; two quotes inside stand for one. One inside a cell that does not
/// begin with it is a letter, as in E".
std::vector<std::string> cells_of(const std::string& line, char separator, const std::string& place) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char letter = line[i];
    if (letter == '"') {
      if (quoted && i + 1 < line.size() && line[i + 1] == '"') {
        cells.back() += '"';
        ++i;
      } else if (quoted || trimmed(cells.back()).empty()) {
        quoted = !quoted;
      } else {
        cells.back() += letter;
      }
    } else if (letter == separator && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += letter;
    }
  }
  if (quoted) refuse_line(place, "a quote does not end on this line");
  for (std::string& cell : cells) cell = trimmed(cell);
  return cells;
}

MeasuredColumn column_of(const std::string& text, const std::string& place) {
  const TableHeading heading = refusing_at(place, [&] { return table_heading(text); });
  return {heading.name, heading.unit, {}, {}, heading.written};
}

char separator_of(const std::string& names) {
  for (const char separator : {'\t', ';', ','})
    if (names.find(separator) != std::string::npos) return separator;
  return ',';
}

/// Whether each byte of a letter beyond ASCII is followed by those that belong to it.
bool is_utf8(std::string_view text) {
  std::size_t following = 0;
  for (const char letter : text) {
    const auto code = static_cast<unsigned char>(letter);
    const bool follows = (code & 0xC0) == 0x80;
    if (follows != (following > 0)) return false;
    if (follows)
      --following;
    else
      following = code < 0x80 ? 0 : code < 0xE0 ? 1 : code < 0xF0 ? 2 : 3;
  }
  return following == 0;
}

/// The text in UTF-8, with lines that end in a line feed. Other bytes than UTF-8 are those of Windows' spreadsheets.
std::string plain_lines(const std::string& text) {
  std::string plain = text.starts_with("\xEF\xBB\xBF") ? text.substr(3) : text;
  if (!is_utf8(plain)) {
    std::string translated;
    for (const char letter : plain) {
      const auto code = static_cast<unsigned char>(letter);
      if (code == 0x91 || code == 0x92)
        translated += '\'';
      else if (code < 0x80)
        translated += letter;
      else
        (translated += static_cast<char>(0xC0 | (code >> 6))) += static_cast<char>(0x80 | (code & 0x3F));
    }
    plain = translated;
  }
  if (plain.find('\n') == std::string::npos) std::replace(plain.begin(), plain.end(), '\r', '\n');
  return plain;
}

/// Whether a row that follows the names tells their units: no cell is a number, each is a unit or empty.
bool is_row_of_units(const MeasuredTable& table, const std::vector<std::string>& cells) {
  bool any = false;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    if (plain_number(cells[i]) || !table.columns[i].unit.empty() ||
        (!cells[i].empty() && !is_unit(without_brackets(cells[i]))))
      return false;
    any = any || (!cells[i].empty() && cells[i] != "-");
  }
  return any;
}

/// "0,25": a number with a decimal comma, which it gets a point for; nothing else.
std::optional<std::string> with_point(const std::string& cell) {
  const std::size_t comma = cell.find(',');
  if (comma == std::string::npos || cell.find('.') != std::string::npos) return std::nullopt;
  std::string pointed = cell;
  pointed[comma] = '.';
  return plain_number(pointed) ? std::optional(pointed) : std::nullopt;
}

/// Gives numbers with decimal commas their points.
void take_decimal_commas(MeasuredTable& table) {
  std::string with_comma, with_dot;
  for (MeasuredColumn& column : table.columns)
    for (std::size_t row = 0; row < table.rows(); ++row) {
      std::string& cell = column.cells[row];
      if (const auto pointed = with_point(cell)) {
        if (with_comma.empty()) with_comma = table.place(row) + ": " + heading(column) + " = " + cell;
        cell = *pointed;
      } else if (cell.find('.') != std::string::npos && plain_number(cell)) {
        with_dot = cell;
      }
    }
  table.decimal_commas = !with_comma.empty();
  if (!with_comma.empty() && !with_dot.empty())
    refuse_line(with_comma, "has a decimal comma, and " + with_dot + " a point: write all with points");
}

/// Where two names that instruments give stand beside each other, without a number: number of the line, or 0.
int line_of_known_names(const std::string& text) {
  constexpr int most_lines = 1000;  // that stand above a table
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; number < most_lines && std::getline(lines, line);) {
    ++number;
    int known = 0;
    bool numbers = false;
    try {
      for (const std::string& cell : cells_of(line, separator_of(line), "")) {
        numbers = plain_number(cell).has_value();
        if (numbers) break;
        known += !cell.empty() && is_measured_name(table_heading(cell).name);
      }
    } catch (const std::invalid_argument&) {  // no line of names
      continue;
    }
    if (known >= 2 && !numbers && trimmed(line).front() != '#') return number;
  }
  return 0;
}

/// Whether a line begins with a word: "Segment;2".
bool begins_with_text(const std::vector<std::string>& cells) {
  const auto first = find_if(cells, [](const std::string& cell) { return !cell.empty(); });
  return first == cells.end() || !(plain_number(*first) || with_point(*first));
}

/// Takes the line of names. @return how many columns at its end have no name
std::size_t take_names(MeasuredTable& table, std::vector<std::string> names, const std::string& place) {
  std::size_t nameless = 0;
  for (; names.size() > 1 && names.back().empty(); ++nameless) names.pop_back();
  for (const std::string& name : names) {
    MeasuredColumn column = column_of(name, place);
    if (table.find(column.name)) refuse_line(place, "\"" + shortened(column.name) + "\": column given twice");
    table.columns.push_back(std::move(column));
  }
  return nameless;
}

/// Takes a row of values, or of units where it stands below the names.
void take_row(MeasuredTable& table, std::vector<std::string> cells, std::size_t nameless, int number) {
  for (std::size_t i = 0; i < nameless && cells.size() > table.columns.size() && cells.back().empty(); ++i)
    cells.pop_back();
  if (cells.size() != table.columns.size())
    refuse_line(line_place(table.file, number),
                std::to_string(cells.size()) + " cells where the first line names " +
                    std::to_string(table.columns.size()) + " columns" +
                    (table.columns.size() == 1 ? "; no line has two names that are known, as \"frequency [Hz];E' "
                                                 "[MPa];E'' [MPa]\", apart by tabs, semicolons or commas"
                                               : ""));
  if (table.lines.empty() && is_row_of_units(table, cells)) {
    for (std::size_t i = 0; i < cells.size(); ++i)
      table.columns[i].unit = cells[i].empty() ? "" : table_heading("x [" + without_brackets(cells[i]) + "]").unit;
    return;
  }
  for (std::size_t i = 0; i < cells.size(); ++i) table.columns[i].cells.push_back(cells[i]);
  table.lines.push_back(number);
}

/// The lines of a table from that of the names on.
struct TableLines {
  MeasuredTable& table;
  std::optional<char> separator = {};
  std::size_t nameless = 0;
  std::string names = {}, units = {};
  int aside = 0;                         // where what stands between two blocks begins
  std::vector<std::string> beside = {};  // its cells

  void take(const std::string& line, const std::string& content, int number) {
    const std::string place = line_place(table.file, number);
    if (table.columns.empty()) {
      if (!separator) separator = separator_of(line);
      names = content;
      table.line_of_names = number;
      nameless = take_names(table, cells_of(line, *separator, place), place);
    } else if (content == names || content == units) {  // of another block
      aside = 0;
    } else if (aside > 0) {
      ++table.passed_over;
    } else {
      take_cells(cells_of(line, *separator, place), content, number);
    }
  }

  void take_cells(const std::vector<std::string>& cells, const std::string& content, int number) {
    const std::size_t before = table.lines.size();
    if (before > 0 && cells.size() != table.columns.size() && begins_with_text(cells)) {
      if (aside == 0) aside = number, beside = cells;
      ++table.passed_over;
      return;
    }
    take_row(table, cells, nameless, number);
    if (before == 0 && table.lines.empty()) units = content;
  }

  void finish() {
    if (table.lines.empty()) refuse_line(table.file, "has no row of measured values");
    if (aside > 0) take_row(table, beside, nameless, aside);  // no further block: it is refused
  }
};

}  // namespace

MeasuredTable read_measured_table(const std::filesystem::path& file) {
  constexpr std::size_t largest = 100'000'000;  // of measured values
  MeasuredTable table{file.string(), whole_file(file, largest), {}, {}};
  if (table.text.empty()) refuse_line(table.file, "is empty");
  const std::string plain = plain_lines(table.text);
  const int known_names = line_of_known_names(plain);
  std::istringstream lines(plain);
  TableLines reading{table};
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    const std::string place = line_place(table.file, ++number);
    if (line.find('\0') != std::string::npos) refuse_line(place, "has a NUL character");
    const std::string content(trimmed(line));
    if (content.empty() || content.front() == '#') continue;
    if (table.columns.empty() && content.starts_with("sep=") && content.size() == 5)  // for spreadsheets
      reading.separator = content.back();
    else if (number < known_names)
      ++table.passed_over;
    else
      reading.take(line, content, number);
  }
  reading.finish();
  take_decimal_commas(table);
  return table;
}

}  // namespace rollres
