#include "core/material/temperature_shift.hpp"

#include <cmath>

#include "core/messages/require.hpp"

namespace rollres {

double shift_factor(const TemperatureShift& shift, double temperature) {
  constexpr double gas_constant = 8.31446261815324;  // [J/(mol K)]
  require_positive("temperature", temperature);
  const double above = temperature - shift.reference;
  switch (shift.law) {
    case ShiftLaw::wlf:
      require(shift.c2 + above > 0, "temperature", temperature, "must be above the reference less c2 for WLF");
      return std::pow(10, -shift.c1 * above / (shift.c2 + above));
    case ShiftLaw::arrhenius:
      return std::exp(shift.activation_energy / gas_constant * (1 / temperature - 1 / shift.reference));
    case ShiftLaw::none:
      break;
  }
  return 1;
}

}  // namespace rollres
