#include "db/queries/column_table.hpp"

#include <cmath>

#include "tests/catch.hpp"

using namespace rollres;

TEST_CASE("a column gives back the cells that it was given, whatever stands among them", "[db][query]") {
  const Cell none, one = 1.0, two = 2.0, count = std::int64_t{3}, text = std::string("slip");
  for (const std::vector<Cell>& cells : {std::vector<Cell>{none, none},
                                         {one, one, one},
                                         {text, text},
                                         {count, count},
                                         {one, two, none, one},
                                         {none, none, two, one},
                                         {one, one, text},
                                         {none, text, none},
                                         {two, one, count},
                                         {count, one},
                                         {none, count},
                                         {text, none, count, one}}) {
    CellColumn column;
    for (const Cell& cell : cells) column.add(cell);
    const bool alike = std::all_of(cells.begin(), cells.end(), [&](const Cell& cell) { return cell == cells.front(); });
    CHECK(column.uniform() == alike);
    std::vector<Cell> sorted = cells;
    std::sort(sorted.begin(), sorted.end());
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    CHECK(column.values() == sorted);
    for (std::size_t row = 0; row < cells.size(); ++row) {
      CHECK(column[row] == cells[row]);
      const double number = column.number(row);
      if (cells[row] == count)
        CHECK(number == 3);
      else if (cells[row] == one || cells[row] == two)
        CHECK(Cell(number) == cells[row]);
      else
        CHECK(std::isnan(number));
    }
  }
  CHECK(CellColumn().values().empty());
}
