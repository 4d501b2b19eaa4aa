#pragma once

/// What else the inputs of a scene are called where rolling is computed, for the refusal of a key that is unknown here.

#include <span>
#include <string>
#include <string_view>

namespace rollres {

/// "unknown key; did you mean speed?" with the input that is nearest to the key, has it as its symbol, or is usually
/// called that; else where all keys are listed.
std::string unknown_input(std::span<const std::string_view> known, std::string_view key);

}  // namespace rollres
