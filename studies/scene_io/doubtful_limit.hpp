#pragma once

/// Limits in formulas that look as if they were in mm, MPa or degC: "layer_thickness < 6 ? 1 : 2"
/// (doubtful_number.hpp).

#include <optional>
#include <string>
#include <string_view>

#include "core/scene/quantity.hpp"

namespace rollres {

/// What a name in a formula stands for: an input, a number of a list, or an output; nothing if it is none of these.
std::optional<Quantity> quantity_named(const std::string& name);

/// Refuses a formula in which a quantity alone is compared with such a number alone; "6 [mm]" has a unit.
/// @throws std::invalid_argument "layer_thickness < 6: did you mean 6 [mm]? ..."
void refuse_doubtful_limits(std::string_view formula, Body body);

}  // namespace rollres
