#pragma once

/// SI units with a decimal prefix, chosen so that numbers are read easily.

#include <string>
#include <string_view>

namespace rollres {

/// A unit with a decimal prefix; value [SI] = number * factor.
struct ScaledUnit {
  std::string name;   ///< "kN/m", "mm2"; empty for a dimensionless number or a text
  double factor = 1;  ///< [SI unit]
};

/// The unit in which a number lies between 1 and 1000, as far as prefixes reach: from n to G, but metres and seconds
/// only go down. What rounds up to the next prefix with five digits takes it.
/// @param unit SI unit as Quantity writes it: "m/s", "N.m", "kg/m3", "1"
/// @param size the magnitude to be shown [unit]; zero or not finite: no prefix
ScaledUnit scaled_unit(std::string_view unit, double size);

/// The same for an axis from `smallest` to `largest` (magnitudes, > 0) in logarithmic spacing: no prefix where the
/// plain unit keeps within 0.001 and 10000, else the prefix that centres the axis about 1.
ScaledUnit scaled_unit_logarithmic(std::string_view unit, double smallest, double largest);

/// A unit as it is printed: "mm2" as "mm²", "N.m" as "N·m".
std::string typeset_unit(std::string_view unit);

}  // namespace rollres
