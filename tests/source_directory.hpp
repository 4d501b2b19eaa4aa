#pragma once

#include <filesystem>
#include <string>

/// Top of the repository that the tests were built from.
const std::filesystem::path& source_directory();

/// A file of studies/examples.
std::string example(const std::string& name);
