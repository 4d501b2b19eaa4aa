#include "studies/stored/read_filter.hpp"

#include <stdexcept>

#include "db/rows/schema.hpp"
#include "studies/scene_io/scene_inputs.hpp"
#include "studies/text/units.hpp"

namespace rollres {

Filter read_filter(const std::string& text) {
  Filter filter = parse_filter(text);
  const QuantityColumn* column = find_quantity_column(filter.column);
  if (!column || column->type != "REAL" || filter.value.empty() || filter.value == "infinite" ||
      plain_number(filter.value))
    return filter;
  const Quantity& quantity = column->quantity;
  double value = 0;
  try {
    try {
      value = is_temperature(quantity) ? kelvin(filter.value) : si_value(filter.value, quantity.unit);
    } catch (const std::invalid_argument&) {
      if (quantity.unit_2d.empty()) throw;
      value = si_value(filter.value, quantity.unit_2d);
    }
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(filter.column + " = " + filter.value + ": " + error.what());
  }
  filter.value = text_of(InputValue(value));
  return filter;
}

}  // namespace rollres
