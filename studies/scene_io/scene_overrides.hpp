#pragma once

/// Entries that take the place of others: of --set, of "set" and axes of studies, of Python and serve. For sources
/// only: it needs nlohmann_json.

#include <string>
#include <vector>

#include "studies/scene_io/scene_entries.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

/// The entries of an object of inputs that replace others, those of further layers among them; their values are checked
/// where they are used.
/// @throws std::invalid_argument for an unknown key
std::vector<SceneEntry> replacing_entries(const Json& object, const std::string& place);

/// The entries of a list of "KEY=VALUE"; a master_curve_file is relative to the working directory.
/// @throws std::invalid_argument for an unknown key, one given twice, or a word without "="
std::vector<SceneEntry> override_entries(const std::vector<std::string>& words, const std::string& place = "--set");

/// `entries` with those of `overrides` in place of their keys and of the inputs these take the place of. An input of a
/// further layer takes its place in the object of that layer.
/// @param taken  inputs that are taken away first, with null as their values
/// @throws std::invalid_argument naming the override of a layer that the entries have not, what cannot be taken away,
/// or the width with which a load that is a plain number would be of another length of the body
std::vector<SceneEntry> overridden(std::vector<SceneEntry> entries, const std::vector<SceneEntry>& overrides,
                                   const std::vector<SceneEntry>& taken = {});

/// A scene's object without the names of tables that the words replace: such a table is not read.
Json without_replaced_tables(Json object, const std::vector<std::string>& words);

}  // namespace rollres
