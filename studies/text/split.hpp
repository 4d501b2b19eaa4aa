#pragma once

#include <string>
#include <vector>

namespace rollres {

/// The words of "speed, load", without the blanks around them; nothing for an empty text.
std::vector<std::string> split_at_commas(const std::string& text);

}  // namespace rollres
