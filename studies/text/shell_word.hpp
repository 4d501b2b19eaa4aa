#pragma once

#include <string>

namespace rollres {

/// A text as one word of the shell.
std::string shell_word(const std::string& text);

}  // namespace rollres
