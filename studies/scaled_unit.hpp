#pragma once

/// Units as people read them: 0.003 m as "3 mm", 20000 N/m as "20 kN/m".

#include <string>
#include <string_view>

namespace rollres {

/// A unit with a decimal prefix; value [SI] = number * factor.
struct ScaledUnit {
  std::string name;   ///< "kN/m", "mm²"; empty for a dimensionless number or a text
  double factor = 1;  ///< [SI unit]
};

/// The unit in which the size of a number is easiest to read: 1 to 1000, as far as its prefixes reach (metres go down
/// to nm and not up to km, seconds down to ns, newtons and watts from µ to G, pascals from k to G).
/// @param unit SI unit as Quantity writes it: "m/s", "N.m", "kg/m3", "1"
/// @param largest the largest magnitude to be shown [unit]; zero or not finite: no prefix
ScaledUnit scaled_unit(std::string_view unit, double largest);

/// The same for an axis from `smallest` to `largest` (magnitudes, > 0) in logarithmic spacing: no prefix where the
/// plain unit keeps within a thousandth and a thousand, else the prefix that centres the axis about 1.
ScaledUnit scaled_unit_logarithmic(std::string_view unit, double smallest, double largest);

/// A number in its own scaled unit with at most `digits` significant digits: "20 kN/m", "0.5", "infinite".
std::string with_scaled_unit(double value, std::string_view unit, int digits = 6);

/// A number with at most `digits` significant digits and no trailing zeros, whatever the locale.
std::string short_number(double value, int digits = 6);

}  // namespace rollres
