#include "studies/stored/workbook.hpp"

#include <xlsxwriter.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "db/file/temporary_folder.hpp"
#include "studies/text/files.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

constexpr std::size_t most_rows = LXW_ROW_MAX - 1, most_columns = LXW_COL_MAX;
constexpr std::size_t longest_text = 32767;  // in a cell

void write_cell(lxw_worksheet* sheet, lxw_row_t row, lxw_col_t column, const Cell& cell) {
  if (const auto* const number = std::get_if<double>(&cell)) {
    if (std::isfinite(*number))
      worksheet_write_number(sheet, row, column, *number, nullptr);
    else if (!std::isnan(*number))
      worksheet_write_string(sheet, row, column, *number > 0 ? "infinite" : "-infinite", nullptr);
  } else if (const auto* const count = std::get_if<std::int64_t>(&cell)) {
    worksheet_write_number(sheet, row, column, static_cast<double>(*count), nullptr);
  } else if (const auto* const text = std::get_if<std::string>(&cell)) {
    if (text->size() > longest_text)
      throw std::invalid_argument("a cell has " + std::to_string(text->size()) + " bytes, a workbook's at most " +
                                  std::to_string(longest_text) + ": choose other columns with --columns, or csv");
    worksheet_write_string(sheet, row, column, text->c_str(), nullptr);
  }
}

}  // namespace

void write_workbook(const std::filesystem::path& file, const Table& table) {
  if (table.rows.size() > most_rows || table.columns.size() > most_columns)
    throw std::invalid_argument(std::to_string(table.rows.size()) + " rows and " +
                                std::to_string(table.columns.size()) + " columns: a workbook has at most " +
                                std::to_string(most_rows) + " and " + std::to_string(most_columns) +
                                "; --limit takes some, csv has all");
  const TemporaryFolder folder;
  const std::string made = (folder / "table.xlsx").string(), temporary = (folder / "").string();
  lxw_workbook_options options{};
  options.tmpdir = const_cast<char*>(temporary.c_str());  // is read alone
  lxw_workbook* const workbook = workbook_new_opt(made.c_str(), &options);
  if (!workbook) throw std::runtime_error(file.string() + ": no memory for a workbook");
  try {
    lxw_worksheet* const sheet = workbook_add_worksheet(workbook, "rollres");
    lxw_format* const bold = workbook_add_format(workbook);
    format_set_bold(bold);
    const auto columns = static_cast<lxw_col_t>(table.columns.size());
    for (lxw_col_t column = 0; column < columns; ++column) {
      const std::string& heading = table.columns[column];
      worksheet_write_string(sheet, 0, column, heading.c_str(), bold);
      worksheet_set_column(sheet, column, column, std::clamp(1.2 * static_cast<double>(heading.size()), 10.0, 40.0),
                           nullptr);
      for (std::size_t row = 0; row < table.rows.size(); ++row)
        write_cell(sheet, static_cast<lxw_row_t>(row + 1), column, table.rows[row][column]);
    }
    worksheet_freeze_panes(sheet, 1, 0);
    if (columns > 0)
      worksheet_autofilter(sheet, 0, 0, static_cast<lxw_row_t>(table.rows.size()), static_cast<lxw_col_t>(columns - 1));
  } catch (...) {
    workbook_close(workbook);
    throw;
  }
  if (const lxw_error error = workbook_close(workbook); error != LXW_NO_ERROR)
    throw std::runtime_error(file.string() + ": cannot be made: " + lxw_strerror(error));
  constexpr std::size_t any_size = std::size_t{1} << 40;
  write_file(file, whole_file(made, any_size));
}

}  // namespace rollres
