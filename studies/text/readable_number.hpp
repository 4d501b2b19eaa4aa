#pragma once

/// Numbers as people read them.

#include <cstddef>
#include <string>
#include <string_view>

namespace rollres {

/// A value with its unit, scaled by a prefix: (0.00036982, "m") gives "369.82 µm", (2.556e6, "Pa") gives "2.556 MPa".
/// Five significant digits; "-" for NaN, "infinite" for infinity; unit "1" or "" shows the number alone.
std::string readable(double value, std::string_view unit);

/// A number rounded to `digits` significant digits, without trailing zeros and, at everyday sizes, without an exponent.
std::string short_number(double value, int digits = 6);

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

}  // namespace rollres
