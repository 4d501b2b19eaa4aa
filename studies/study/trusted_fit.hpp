#pragma once

/// A fit of a database whose errors may be relied on, as a file names it: {"name": "rig", "db": "results.db"}.

#include <array>
#include <filesystem>
#include <string>
#include <string_view>

#include "db/rows/fit_store.hpp"
#include "studies/study/study_keys.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

inline constexpr std::array stored_fit_keys{
    FileKey{"name", "name of the fit in the database", a_name, is_needed},
    FileKey{"db", "database, relative to this file", a_name, is_needed},
};

/// @param given  what stands in a file under `key`  @param file  that file  @param place  of the key, for messages
/// @throws std::invalid_argument naming place, key, value and rule where there is no such fit or its status is neither
///         GOOD nor USABLE WITH WARNINGS
/// @throws std::runtime_error if the database cannot be read
FitRecord trusted_fit(const Json& given, const std::filesystem::path& file, const std::string& place,
                      std::string_view key);

/// The standard error of a fit's parameter [SI]. @throws std::invalid_argument naming the parameter if it has none
double trusted_error(const FitParameterRecord& parameter);

}  // namespace rollres
