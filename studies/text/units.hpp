#pragma once

/// Numbers with a unit as people write them: "5 mm", "20 kN/m", "36 km/h", "3 MPa". The units are those of UDUNITS-2.

#include <optional>
#include <string>
#include <string_view>

namespace rollres {

/// A plain decimal number and nothing else, independent of the locale: "0.25", "-1e-3". Empty if `text` is not one, or
/// if it is not finite.
std::optional<double> plain_number(std::string_view text);

/// A share: 0.02 of "2 %". Empty if `text` is not one.
std::optional<double> percentage(std::string_view text);

/// Converts a number with a unit to SI; the result has 15 significant digits, so that "5 mm" is 0.005 exactly.
/// May be called from several threads.
/// @param text number, optional blanks, unit
/// @param unit the wanted SI unit: "m", "N/m", "kg/m3"; "1" if dimensionless
/// @throws std::invalid_argument the rule that is broken: "must have a unit of speed (m/s)"
/// @throws std::runtime_error if the database of units is not installed
double si_value(std::string_view text, std::string_view unit);

/// A temperature on a scale with any origin in K: "20 degC", "-4 °F", "293.15 K"; 15 significant digits.
/// @throws as si_value
double kelvin(std::string_view text);

/// A unit with what it measures: "a unit of speed (m/s)".
std::string unit_in_words(std::string_view unit);

}  // namespace rollres
