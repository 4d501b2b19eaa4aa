#pragma once

/// Keys as people read them, on axes, in legends and in tables.

#include <string>
#include <string_view>

#include "core/scene/quantity.hpp"

namespace rollres {

/// "rolling resistance", "layer thickness of coating 1"
std::string in_words(std::string_view key);

/// The symbol of a quantity where its name in words stands beside it: "H", not "H of coating 1".
std::string_view symbol_beside_name(const Quantity& quantity);

}  // namespace rollres
