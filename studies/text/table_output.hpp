#pragma once

/// Tables of stored results as text.

#include <algorithm>
#include <array>
#include <iosfwd>
#include <string>
#include <string_view>

#include "db/queries/column_table.hpp"

namespace rollres {

/// Aligned columns under their names, if they have some, six digits.
/// @param absent stands where a cell holds nothing   @param indent before each line
void write_aligned(std::ostream& out, const Table& table, std::string_view absent = "-", std::string_view indent = "");

/// Letters of its longest line.
std::size_t aligned_width(const Table& table);

/// The same as a table of Markdown.
void write_markdown(std::ostream& out, const Table& table);

/// RFC 4180 with a line of names; all digits; empty where something is absent, "inf" for an infinite number.
void write_csv(std::ostream& out, const Table& table);
void write_csv(std::ostream& out, const ColumnTable& table);

/// The same as a text.
std::string csv_of(const Table& table);
std::string csv_of(const ColumnTable& table);

/// An array with one object for each row; all digits; null where something is absent, "infinite" for an infinite
/// number.
void write_json(std::ostream& out, const Table& table);

/// The objects of write_json, each on a line of its own (JSON lines).
void write_json_lines(std::ostream& out, const Table& table);

inline constexpr std::array<std::string_view, 5> table_formats{"table", "csv", "json", "jsonl", "markdown"};

/// These, and a command's own.
template <std::size_t N>
constexpr auto table_formats_and(const std::array<std::string_view, N>& more) {
  std::array<std::string_view, table_formats.size() + N> all{};
  std::copy(more.begin(), more.end(), std::copy(table_formats.begin(), table_formats.end(), all.begin()));
  return all;
}

/// One of the above, by its name; of an empty table nothing as "table".
void write_table(std::ostream& out, const Table& table, std::string_view format);

}  // namespace rollres
