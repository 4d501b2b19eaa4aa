#pragma once

/// A unit by itself, in base units of the SI.

#include <array>
#include <string>
#include <string_view>

namespace rollres {

/// Units of money, of which none is so many of another.
inline constexpr std::array<std::string_view, 4> currencies{"EUR", "USD", "GBP", "CHF"};

/// Exponents of metre, kilogram, second, kelvin, mole and the currencies.
using UnitExponents = std::array<double, 5 + currencies.size()>;

/// A unit by itself: "kN/m2" is 1000 kg/m/s2.
struct UnitInSi {
  double size = 1;
  UnitExponents exponents{};
};

/// @throws std::invalid_argument if it is no unit, or one with an origin (degC)
/// @throws std::runtime_error if the database of units is not installed
UnitInSi unit_in_si(const std::string& unit);

}  // namespace rollres
