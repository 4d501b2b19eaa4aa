#pragma once

/// Numbers as people read them, in SI units with a decimal prefix chosen so that they are read easily.

#include <cstddef>
#include <string>
#include <string_view>

#include "core/scene/quantity.hpp"

namespace rollres {

/// Digits of a number in tables and summaries.
inline constexpr int shown_digits = 5;

/// A value with its unit, scaled by a prefix: (0.00036982, "m") gives "369.82 µm", (2.556e6, "Pa") gives "2.556 MPa".
/// Five significant digits; "-" for NaN, "infinite" for infinity; unit "1" or "" shows the number alone.
std::string readable(double value, std::string_view unit);

/// The same of a quantity: temperatures are read in degrees Celsius.
std::string readable(const Quantity& quantity, double value, std::string_view unit);

/// The number that `short_number` writes.
double to_digits(double value, int digits = shown_digits);

/// A number rounded to `digits` significant digits, without trailing zeros and, at everyday sizes, without an exponent.
std::string short_number(double value, int digits = 6);

/// "2013-05-01T12:00:00.000Z" to the second, as it is read; another text as it is.
std::string to_the_second(const std::string& time);

/// 100 times the number, with its sign: "12.3 %"; "-" if it is not finite.
std::string percent(double part, int digits = 3);

/// A number as short as it can be read back without loss.
std::string shortest(double value);

/// " [m/s]" behind the name of a column; empty for a unit "1" or none.
std::string unit_in_brackets(std::string_view unit);

/// Number of letters of a UTF-8 text, for aligning columns.
std::size_t width(std::string_view text);

/// The text filled with blanks on its right to `columns` letters.
std::string padded(std::string_view text, std::size_t columns);

/// A unit with a decimal prefix, or degrees Celsius; value [SI] = origin + number * factor.
struct ScaledUnit {
  std::string name;   ///< "kN/m", "mm2"; empty for a dimensionless number or a text
  double factor = 1;  ///< [SI unit]
  double origin = 0;  ///< [SI unit]

  double number(double value) const { return (value - origin) / factor; }
};

/// The unit in which a number lies between 1 and 1000, as far as prefixes reach: from n to G, but metres and seconds
/// only go down. What rounds up to the next prefix with five digits takes it.
/// @param unit SI unit as Quantity writes it: "m/s", "N.m", "kg/m3", "1"
/// @param size the magnitude to be shown [unit]; zero or not finite: no prefix
ScaledUnit scaled_unit(std::string_view unit, double size);

/// The same for an axis from `smallest` to `largest` (magnitudes, > 0) in logarithmic spacing: no prefix where the
/// largest number is between 1 and 10000; below that it is scaled to lie between 1 and 1000, and above it the prefix
/// centres the axis about 1.
ScaledUnit scaled_unit_logarithmic(std::string_view unit, double smallest, double largest);

/// The scale of temperatures: 293.15 K is 20 °C.
ScaledUnit celsius();

/// A unit as it is printed: "mm2" as "mm²", "N.m" as "N·m".
std::string typeset_unit(std::string_view unit);

}  // namespace rollres
