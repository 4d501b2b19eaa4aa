#pragma once

/// The manual page rollres(1), of all that the commands declare of themselves.

#include <string>

#include "studies/program/command_line.hpp"

namespace rollres {

/// The page as man reads it (groff's macros "man"), in UTF-8.
/// @param version "rollres 0.1.0"
std::string manual_page(const CommandWords& program, const std::string& version);

}  // namespace rollres
