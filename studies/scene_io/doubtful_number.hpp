#pragma once

/// Numbers of inputs that look as if they were given in another unit than that of the SI: a length above 1 m, a modulus
/// below 1 kPa or above 1 TPa, a temperature below 150 K, an angle above 0.35 rad, a molar energy below 1 kJ/mol. Bare
/// ones are refused, as the text "6 m" they are meant; what the program writes itself has the unit. For sources only:
/// it needs nlohmann_json.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/quantity.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

/// The rule that a bare number of this input breaks; empty if it looks like one in SI.
std::string doubt_of(const Quantity& quantity, double value);

/// The same of a standard deviation or an offset of what is measured in this unit.
std::string doubt_of_measured(std::string_view unit, double value);

/// The same of a value that inputs and answers of stored rows are compared with; stresses, too.
std::string doubt_of_filter(const Quantity& quantity, double value);

/// The same of a limit that such a number is compared with, in a formula, of inputs and of answers; stresses, too.
/// @param unit  of the quantity, for the body
std::string doubt_of_limit(const Quantity& quantity, std::string_view unit, double value);

/// Of a list of them the number that tells its unit, by its place: the largest, of temperatures the smallest. A series
/// has moduli as small as one likes beside others. @param values  at least one
std::size_t telling_place(const Quantity& quantity, const std::vector<double>& values);

/// A number or a list as a scene file has it, with the unit where a bare number is refused.
Json written_input(const Quantity& quantity, double value);
Json written_input(const Quantity& quantity, const std::vector<double>& values);

/// What a name in a formula stands for: an input, a number of a list, or an output; nothing if it is none of these.
std::optional<Quantity> quantity_named(const std::string& name);

/// Refuses a formula in which a quantity alone is compared with such a number alone; "6 [mm]" has a unit.
/// @throws std::invalid_argument "layer_thickness < 6: did you mean 6 [mm]? ..."
void refuse_doubtful_limits(std::string_view formula, Body body);

}  // namespace rollres
