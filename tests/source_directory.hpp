#pragma once

#include <filesystem>

/// Top of the repository that the tests were built from.
const std::filesystem::path& source_directory();
