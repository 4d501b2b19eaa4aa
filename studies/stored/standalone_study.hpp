#pragma once

#include <filesystem>
#include <string>

namespace rollres {

/// Text of a study file that needs no other file: the scene stands in it in place of the name of its file, and a
/// master curve's lists in place of the name of theirs. The text is
/// left as it is if it does already.
/// @throws std::invalid_argument, std::runtime_error as read_study, of which this is no check
std::string standalone_study(const std::filesystem::path& file);

}  // namespace rollres
