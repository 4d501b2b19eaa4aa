#include "db/queries/column_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace rollres {

namespace {

bool is_count_or_text(const Cell& cell) {
  return std::holds_alternative<std::int64_t>(cell) || std::holds_alternative<std::string>(cell);
}

double number_of(const Cell& cell) { return number_in(cell).value_or(std::numeric_limits<double>::quiet_NaN()); }

Cell cell_of(double number) { return std::isnan(number) ? Cell() : Cell(number); }

}  // namespace

void CellColumn::add(Cell cell) {
  if (size_ == 0) first_ = cell;
  if (uniform() && cell != first_) {
    if (is_count_or_text(first_))
      cells_.assign(size_, first_);
    else
      numbers_.assign(size_, number_of(first_));
  }
  if (!numbers_.empty() && is_count_or_text(cell)) {
    for (const double number : numbers_) cells_.push_back(cell_of(number));
    numbers_ = {};
  }
  ++size_;
  if (!numbers_.empty())
    numbers_.push_back(number_of(cell));
  else if (!cells_.empty())
    cells_.push_back(std::move(cell));
}

Cell CellColumn::operator[](std::size_t row) const {
  return !numbers_.empty() ? cell_of(numbers_[row]) : cells_.empty() ? first_ : cells_[row];
}

double CellColumn::number(std::size_t row) const {
  return !numbers_.empty() ? numbers_[row] : number_of(cells_.empty() ? first_ : cells_[row]);
}

std::vector<Cell> CellColumn::values() const {
  std::vector<Cell> values;
  if (!numbers_.empty()) {
    std::vector<double> numbers;
    for (const double number : numbers_)
      if (!std::isnan(number)) numbers.push_back(number);
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    if (std::any_of(numbers_.begin(), numbers_.end(), [](double number) { return std::isnan(number); }))
      values.emplace_back();
    values.insert(values.end(), numbers.begin(), numbers.end());
    return values;
  }
  values = uniform() ? std::vector<Cell>(size_ > 0 ? 1 : 0, first_) : cells_;
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

}  // namespace rollres
