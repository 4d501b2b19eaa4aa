#pragma once

/// Files and folders as a whole. A name that is empty or has a NUL is wrong input (std::invalid_argument).

#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>

namespace rollres {

/// The text of a file, which may be UTF-16 with its byte order mark, as Windows' programs write it; as UTF-8.
/// @param largest  so many bytes at most: /dev/zero has no end
/// @throws std::runtime_error "path: cannot be read: why"
std::string whole_file(const std::filesystem::path& file, std::size_t largest);

/// The bytes of a file of our own. @throws std::runtime_error "path: cannot be read"
std::string content_of(const std::filesystem::path& file);

/// Writes a whole file: to a temporary name beside it, then renamed, so that nobody ever sees half of it. A link stays,
/// and the file it leads to is replaced; a device or a pipe is written to.
/// @throws std::runtime_error with the path and the system's words; the old file is then still there
void write_file(const std::filesystem::path& file, std::string_view content);

/// Refuses a name whose ending tells another kind of picture or document than those that can be written.
/// @param possible  endings: ".svg"
/// @throws std::invalid_argument naming both
void refuse_other_kind(const std::filesystem::path& file, std::initializer_list<std::string_view> possible);

/// Creates a directory and those above it.
/// @throws std::runtime_error with the path and the system's words
void make_directory(const std::filesystem::path& directory);

}  // namespace rollres
