#pragma once

/// Inputs as they were given, before units and rules. For sources only: it needs nlohmann_json.

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/bonded_layer.hpp"
#include "core/scene/scene.hpp"
#include "studies/scene_io/scene_inputs.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

struct SceneEntry {
  std::string key;
  Json value;
  std::string place;  ///< file, "--set", ...
};

/// Keys of a scene file that are no inputs; their values are texts that the program ignores.
inline constexpr std::array<std::string_view, 2> ignored_keys{"$schema", "comment"};

/// The entries of a scene object without what is ignored, each checked by itself; of a master_curve_file its lists.
/// @param folder that the name of such a file is relative to
/// @throws std::invalid_argument for an unknown key or a wrong value
std::vector<SceneEntry> scene_entries(const Json& object, const std::filesystem::path& folder,
                                      const std::string& place);

/// The entries of an object of inputs that replace others, those of further layers among them; their values are checked
/// where they are used.
/// @throws std::invalid_argument for an unknown key
std::vector<SceneEntry> replacing_entries(const Json& object, const std::string& place);

/// The entries of a list of "KEY=VALUE"; a master_curve_file is relative to the working directory.
/// @throws std::invalid_argument for an unknown key, one given twice, or a word without "="
std::vector<SceneEntry> override_entries(const std::vector<std::string>& words, const std::string& place = "--set");

/// `entries` with those of `overrides` in place of their keys and of the inputs these take the place of. An input of a
/// further layer takes its place in the object of that layer.
/// @throws std::invalid_argument naming the override of a layer that the entries have not
std::vector<SceneEntry> overridden(std::vector<SceneEntry> entries, const std::vector<SceneEntry>& overrides);

/// An entry under the key of the input that its own is another way to write: a radius for a diameter.
/// @throws std::invalid_argument as input_value
SceneEntry held_entry(SceneEntry entry);

/// The value that the entries give an input, or nullptr.
const Json* value_given(const std::vector<SceneEntry>& entries, std::string_view key);

/// An entry's value, in SI and inside the range of its input, as the scene holds it.
/// @throws std::invalid_argument naming place, key, value and rule
InputValue input_value(const SceneEntry& entry, Body body);

/// The same for an input of this kind, whatever the entry's key.
InputValue input_value(const SceneEntry& entry, const InputKind& kind, Body body);

/// The body that the entries give: the units of other inputs depend on it, and on whether its width is given.
Indenter indenter_of(const std::vector<SceneEntry>& entries);
Body body_of(const std::vector<SceneEntry>& entries);

/// The scene that the entries give.
/// @param place named in messages about what is missing and what does not go together
/// @throws std::invalid_argument
RollingScene scene_from(const std::vector<SceneEntry>& entries, const std::string& place);

/// The same before the rules of `check`: nothing that is needed is missing, but what must go together may not.
RollingScene unchecked_scene_from(const std::vector<SceneEntry>& entries, const std::string& place);

/// The layers of an entry "lower_layers" or "coating_layers": a list of objects whose keys are those of a scene's own
/// layer.
/// @throws std::invalid_argument naming place, layer and key, value and rule
BondedLayers layers_of(const SceneEntry& entry);

}  // namespace rollres
