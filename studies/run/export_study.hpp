#pragma once

/// A stored study as a folder that stands alone:
///
///     study.json       the study file, with its scene
///     results.csv      the view `result`: one line for each answered point
///     results.db       the same as a database, with the study and what belongs to it
///     provenance.json  which programs on which machines computed how many of the points
///     README.txt       what is what

#include <filesystem>
#include <string>

#include "db/merge/merge.hpp"

namespace rollres {

/// Files of that name in the folder are replaced, each as a whole.
/// @param study its name; may be empty if the database holds one
/// @return what is worth knowing: that the scene is not in the study file, as this version did not store it; or empty
/// @throws std::invalid_argument if there is no such study, or the folder holds another one
/// @throws std::runtime_error naming the file or folder that failed
std::string export_study(const std::filesystem::path& database, const std::string& study,
                         const std::filesystem::path& folder);

/// Merges the results of such a folder.
/// @throws as merge
MergeReport import_study(const std::filesystem::path& folder, const Database& into);

}  // namespace rollres
