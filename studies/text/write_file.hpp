#pragma once

#include <filesystem>
#include <string_view>

namespace rollres {

/// Writes a whole file: to a temporary name beside it, then renamed, so that nobody ever sees half of it.
/// @throws std::runtime_error with the path and the system's words; the old file is then still there
void write_file(const std::filesystem::path& file, std::string_view content);

/// Creates a directory and those above it.
/// @throws std::runtime_error with the path and the system's words
void make_directory(const std::filesystem::path& directory);

}  // namespace rollres
