#pragma once

/// What the value of a formula is measured in, from the units of the numbers in it.
///
/// If the terms of a formula fit, another size of a base unit changes its value by a power of that size, the same
/// everywhere: f(λ^d1 x1, λ^d2 x2, ...) = λ^D f(x1, x2, ...) (Bridgman, 1922, "Dimensional Analysis", chapter 2). This
/// is asked of metre, kilogram, second, kelvin, mole and each currency, one after the other, at a few places. Numbers
/// have no unit but what stands in brackets behind them; what is compared with one, as in "speed < 2 ? 0.3 : 0.7", is
/// compared in SI.

#include <optional>
#include <string>
#include <string_view>

#include "studies/scene_io/formula.hpp"

namespace rollres {

/// The SI unit of the formula's value: "m/s", "1"; nothing if its terms do not fit, empty if it has no value at most
/// places, so that nothing can be told.
std::optional<std::string> unit_of_value(const Formula& formula, Body body);

/// The SI unit of a product, from those of its factors.
std::string product_of_units(std::string_view one, std::string_view other);

/// The numbers of a formula with their units, for messages: "speed [m/s], radius [m]".
std::string units_in(const Formula& formula, Body body);

}  // namespace rollres
