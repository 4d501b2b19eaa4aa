#pragma once

#include <string>
#include <string_view>

namespace rollres {

/// FNV-1a of 128 bits (Fowler, Noll and Vo; IETF draft-eastlake-fnv), in 32 hexadecimal digits.
std::string digest(std::string_view text);

}  // namespace rollres
