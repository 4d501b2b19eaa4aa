#pragma once

/// Inputs as they were given, before units and rules. For sources only: it needs nlohmann_json.

#include <string>
#include <string_view>
#include <vector>

#include "core/scene.hpp"
#include "studies/scene_inputs.hpp"
#include "studies/strict_json.hpp"

namespace rollres {

struct SceneEntry {
  std::string key;
  Json value;
  std::string place;  ///< file, "--set", ...
};

/// The entries of a scene object without its comment, each checked by itself.
/// @throws std::invalid_argument for an unknown key or a wrong value
std::vector<SceneEntry> scene_entries(const Json& object, const std::string& place);

/// The entries of a list of "KEY=VALUE".
/// @throws std::invalid_argument for an unknown key, one given twice, or a word without "="
std::vector<SceneEntry> override_entries(const std::vector<std::string>& words, const std::string& place = "--set");

/// `entries` with those of `overrides` in place of their keys and of the inputs these take the place of.
std::vector<SceneEntry> overridden(std::vector<SceneEntry> entries, const std::vector<SceneEntry>& overrides);

/// An entry's value, in SI and inside the range of its input.
/// @throws std::invalid_argument naming place, key, value and rule
InputValue input_value(const SceneEntry& entry, Indenter indenter);

/// The scene that the entries give.
/// @param place named in messages about what is missing and what does not go together
/// @throws std::invalid_argument
RollingScene scene_from(const std::vector<SceneEntry>& entries, const std::string& place);

}  // namespace rollres
