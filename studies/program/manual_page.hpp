#pragma once

/// The manual page rollres(1), of all that the commands declare of themselves.

#include <string>
#include <vector>

#include "studies/program/command_line.hpp"

namespace rollres {

struct ManualEntry {
  std::string head, text;
};
/// A list of keys with their meanings.
struct ManualSection {
  std::string title;
  std::vector<ManualEntry> entries;
};

/// The page as man reads it (groff's macros "man"), in UTF-8.
/// @param version "rollres 1.0.0"
/// @param files  what may stand in files
std::string manual_page(const CommandWords& program, const std::string& version,
                        const std::vector<ManualSection>& files = {});

}  // namespace rollres
