#pragma once

/// Short texts that stand for long ones, and numbers as keys write them.

#include <string>
#include <string_view>

namespace rollres {

/// FNV-1a of 128 bits (Fowler, Noll and Vo; IETF draft-eastlake-fnv), in 32 hexadecimal digits.
std::string digest(std::string_view text);

/// A number as it is told from others: rounded to 12 significant digits, without a sign of zero. "1.00000000000e-01"
std::string twelve_digits(double value);

}  // namespace rollres
