#pragma once

/// Messages that say the same of different numbers.

#include <string>
#include <vector>

namespace rollres {

/// Texts that differ only in their numbers become one, with the ranges of these: "at 2 m/s" and "at 5 m/s" become "at 2
/// to 5 m/s". In the order given.
std::vector<std::string> with_ranges(const std::vector<std::string>& texts);

}  // namespace rollres
