#pragma once

/// gnuplot's own ways: its strings, its markup, and running it.

#include <filesystem>
#include <string>
#include <string_view>

namespace rollres::gnuplot {

/// A string constant of gnuplot that says exactly `text`; nothing in it is expanded or executed.
/// Control characters become blanks.
std::string quoted(std::string_view text);

/// Text in which gnuplot's markup (^ _ @ & ~ { } \) stands for itself.
std::string plain(std::string_view text);

/// A symbol as Quantity writes it ("R_r", "G0", "τ_xz", "RΩ/V") in markup: letters in italics, indices lowered.
std::string symbol(std::string_view text);

/// Runs a script with gnuplot in the script's own folder, without the user's start-up files.
/// @param program name or path of gnuplot
/// @throws std::runtime_error if it cannot be started or fails, with its own words
void run(const std::filesystem::path& script, const std::string& program = "gnuplot");

}  // namespace rollres::gnuplot
