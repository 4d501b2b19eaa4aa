#pragma once

/// Lists of numbers as text: "[0.1, 1, 10]", each number as short as every bit of it can be read back.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rollres {

std::string text_of_list(std::span<const double> numbers);

/// The list in a text of that form, or nothing if it has another or a number is not finite.
std::optional<std::vector<double>> list_in(std::string_view text);

}  // namespace rollres
