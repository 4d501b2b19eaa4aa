#include "studies/charts/resistance_error.hpp"

#include <cmath>

namespace rollres {

namespace {

bool is_resistance(const std::string& key) {
  return key == "rolling_resistance" || key == "rolling_resistance_coefficient";
}

}  // namespace

ResistanceError::ResistanceError(const QuantityColumn& column) {
  if (find_quantity_column(column.name) && !is_resistance(column.name)) return;
  Formula formula(is_resistance(column.name) ? column.name : std::string(column.quantity.meaning),
                  FormulaNames::inputs_and_outputs);
  const std::vector<std::string>& keys = formula.keys();
  if (any_of(keys, is_resistance)) formula_ = std::move(formula);
}

double ResistanceError::operator()(const StudyRows& rows, std::size_t row) const {
  const double error = rows.number(row, "error_estimate");
  const auto value = [&](double larger) {
    return (*formula_)([&](const std::string& key) {
      const QuantityColumn* const column = find_quantity_column(key);
      return (column ? rows.number(row, *column) : RollingSolution::absent) * (is_resistance(key) ? larger : 1);
    });
  };
  return std::abs(value(1 + error) / value(1) - 1);
}

}  // namespace rollres
