#pragma once

/// Reads variants, the named sets of inputs that go together, under "axes" of a study or "variables" of an
/// optimisation:
///
///     "variant": {"soft": {"static_shear_modulus": "1 MPa", "creep_time": "1 ms"},
///                 "hard": {"material": "master_curve", "master_curve_file": "hard.csv"}}
///
/// "master_curve_file": ["soft.csv", "hard.csv"] is short for one variant of each file, named after it.
/// For sources only: it needs nlohmann_json.

#include <filesystem>
#include <string>
#include <vector>

#include "studies/scene_io/scene_entries.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

struct GivenVariant {
  std::string name;
  std::vector<SceneEntry> entries;  ///< of a master_curve_file its lists
};

/// Whether a key of "axes" or "variables" stands for variants and not for an input.
bool is_of_variants(std::string_view key);

/// The variants among what varies; none if there are none.
/// @param folder  that names of files are relative to   @param place  of `varied`, for messages
/// @throws std::invalid_argument naming place, variant, key, value and rule
/// @throws std::runtime_error if a master curve's file cannot be read
std::vector<GivenVariant> given_variants(const Json& varied, const std::filesystem::path& folder,
                                         const std::string& place);

/// Refuses a variant that gives an input which is given elsewhere, too, or one that excludes it.
/// @param elsewhere  in words: "is an axis of the study too"
void refuse_given_twice(const std::vector<GivenVariant>& variants, std::string_view key, const std::string& elsewhere);

/// Puts the lists of master curves in place of the names of their files.
/// @return whether there were any
bool inline_variants(Json& varied, const std::filesystem::path& folder, const std::string& place);

}  // namespace rollres
