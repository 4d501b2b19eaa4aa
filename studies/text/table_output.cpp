#include "studies/text/table_output.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>

#include "studies/text/readable_number.hpp"
#include "studies/text/table_json.hpp"
#include "studies/text/units.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

std::string in_words(const Cell& cell, std::string_view absent) {
  if (const auto* count = std::get_if<std::int64_t>(&cell)) return std::to_string(*count);
  if (const auto* number = std::get_if<double>(&cell))
    return std::isinf(*number) ? "infinite" : message_text<6>(*number);
  if (const auto* text = std::get_if<std::string>(&cell); text && !text->empty()) {
    std::string line = *text;
    std::replace(line.begin(), line.end(), '\n', ';');
    return line;
  }
  return std::string(absent);
}

/// Whether a spreadsheet would compute a text: it begins like a formula and is no number.
bool is_formula(std::string_view text) {
  return !text.empty() && std::string_view("=+-@\t\r").find(text.front()) != std::string_view::npos &&
         !plain_number(text);
}

std::string csv_cell(const Cell& cell) {
  if (std::holds_alternative<std::monostate>(cell)) return "";
  if (const auto* count = std::get_if<std::int64_t>(&cell)) return std::to_string(*count);
  if (const auto* number = std::get_if<double>(&cell))
    return std::isinf(*number) ? (*number > 0 ? "inf" : "-inf") : shortest(*number);
  const std::string& text = std::get<std::string>(cell);
  if (is_formula(text)) return "\"'" + replaced(text, {{'"', "\"\""}}) + '"';
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  return '"' + replaced(text, {{'"', "\"\""}}) + '"';
}

/// The names and then each row as texts; columns that hold texts stand to the left.
struct WordedTable {
  std::vector<std::vector<std::string>> lines;
  std::vector<std::size_t> widths;
  std::vector<bool> left;

  explicit WordedTable(const Table& table, std::string_view absent = "-")
      : lines{table.columns}, widths(table.columns.size(), 0) {
    for (const auto& row : table.rows) {
      lines.emplace_back();
      for (const Cell& cell : row) lines.back().push_back(in_words(cell, absent));
    }
    for (const auto& line : lines)
      for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], width(line[i]));
    for (std::size_t i = 0; i < widths.size(); ++i)
      left.push_back(any_of(table.rows, [&](const auto& row) { return std::holds_alternative<std::string>(row[i]); }));
  }

  std::string padded(const std::vector<std::string>& line, std::size_t i) const {
    const std::string blanks(widths[i] - width(line[i]), ' ');
    return left[i] ? line[i] + blanks : blanks + line[i];
  }
};

}  // namespace

Json json_of(const Cell& cell) {
  if (std::holds_alternative<std::monostate>(cell)) return nullptr;
  if (const auto* count = std::get_if<std::int64_t>(&cell)) return *count;
  if (const auto* number = std::get_if<double>(&cell)) {
    if (std::isinf(*number)) return *number > 0 ? "infinite" : "-infinite";
    return *number;
  }
  return std::get<std::string>(cell);
}

Json finite_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json json_of_pairs(std::span<Json> parts) {
  Json object = Json::object();
  for (std::size_t i = 0; i + 1 < parts.size(); i += 2)
    object[parts[i].get_ref<const std::string&>()] = std::move(parts[i + 1]);
  return object;
}

Json json_of(const Table& table) {
  Json rows = Json::array();
  for (const auto& row : table.rows) {
    Json& object = rows.emplace_back(Json::object());
    for (std::size_t i = 0; i < row.size(); ++i) object[table.columns[i]] = json_of(row[i]);
  }
  return rows;
}

Json json_of(const Provenance& program) {
  return json_object("version", program.version, "git_hash", program.git_hash, "solver", program.solver, "compiler",
                     program.compiler, "machine", program.machine);
}

std::string text_of(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

void write_aligned(std::ostream& out, const Table& table, std::string_view absent, std::string_view indent) {
  const WordedTable worded(table, absent);
  for (const auto& line : worded.lines) {
    std::string text(indent);
    for (std::size_t i = 0; i < line.size(); ++i) text += (i > 0 ? "  " : "") + worded.padded(line, i);
    text.erase(text.find_last_not_of(' ') + 1);
    if (!text.empty()) out << text << '\n';
  }
}

std::size_t aligned_width(const Table& table) {
  const WordedTable worded(table);
  std::size_t letters = 0;
  for (const std::size_t column : worded.widths) letters += column + 2;
  return letters - std::min<std::size_t>(letters, 2);
}

void write_markdown(std::ostream& out, const Table& table) {
  Table escaped = table;
  for (auto& row : escaped.rows)
    for (Cell& cell : row)
      if (auto* const text = std::get_if<std::string>(&cell)) *text = replaced(*text, {{'|', "\\|"}});
  const WordedTable worded(escaped);
  const auto write_line = [&](const std::vector<std::string>& line) {
    for (std::size_t i = 0; i < line.size(); ++i) out << "| " << worded.padded(line, i) << ' ';
    out << "|\n";
  };
  write_line(worded.lines.front());
  for (std::size_t i = 0; i < worded.widths.size(); ++i)
    out << '|' << std::string(worded.widths[i] + 1, '-') << (worded.left[i] ? '-' : ':');
  out << "|\n";
  for (std::size_t i = 1; i < worded.lines.size(); ++i) write_line(worded.lines[i]);
}

namespace {

template <class CellAt>
void write_csv_of(std::ostream& out, const std::vector<std::string>& names, std::size_t rows, const CellAt& cell_at) {
  for (std::size_t column = 0; column < names.size(); ++column) out << (column > 0 ? "," : "") << names[column];
  out << '\n';
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < names.size(); ++column)
      out << (column > 0 ? "," : "") << csv_cell(cell_at(row, column));
    out << '\n';
  }
}

template <class AnyTable>
std::string csv_text(const AnyTable& table) {
  std::ostringstream text;
  write_csv(text, table);
  return std::move(text).str();
}

}  // namespace

void write_csv(std::ostream& out, const Table& table) {
  write_csv_of(out, table.columns, table.rows.size(),
               [&](std::size_t row, std::size_t column) -> const Cell& { return table.rows[row][column]; });
}

void write_csv(std::ostream& out, const ColumnTable& table) {
  write_csv_of(out, table.names, table.rows,
               [&](std::size_t row, std::size_t column) { return table.columns[column][row]; });
}

std::string csv_of(const Table& table) { return csv_text(table); }
std::string csv_of(const ColumnTable& table) { return csv_text(table); }

void write_json(std::ostream& out, const Table& table) {
  const Json rows = json_of(table);
  const char* begin = "[\n  ";
  for (const Json& row : rows) {
    out << begin << text_of(row, -1);
    begin = ",\n  ";
  }
  out << (rows.empty() ? "[]" : "\n]") << '\n';
}

void write_json_lines(std::ostream& out, const Table& table) {
  for (const Json& row : json_of(table)) out << text_of(row, -1) << '\n';
}

void write_table(std::ostream& out, const Table& table, std::string_view format) {
  if (format == "csv") return write_csv(out, table);
  if (format == "json") return write_json(out, table);
  if (format == "jsonl") return write_json_lines(out, table);
  if (format == "markdown") return write_markdown(out, table);
  if (!table.rows.empty()) write_aligned(out, table);
}

}  // namespace rollres
