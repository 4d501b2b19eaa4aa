#pragma once

/// Tables as workbooks for Excel, LibreOffice and other spreadsheets (Office Open XML), where numbers are numbers
/// whatever the language of the machine writes for a decimal point.

#include <filesystem>

#include "db/queries/table.hpp"

namespace rollres {

/// One sheet: a line of headings that stays in sight, a filter on each column. An infinite number is the text
/// "infinite", an absent one an empty cell, and no text is a formula.
/// @throws std::invalid_argument if the table has more rows or columns than a sheet
/// @throws std::runtime_error if the file cannot be written
void write_workbook(const std::filesystem::path& file, const Table& table);

}  // namespace rollres
