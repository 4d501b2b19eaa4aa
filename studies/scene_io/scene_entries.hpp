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
  std::string place;       ///< file, "--set", ...
  std::string table = {};  ///< "master_curve_file" of what such a table gives; empty otherwise
};

/// Keys of a scene file that are no inputs; their values are texts that the program ignores.
inline constexpr std::array<std::string_view, 2> ignored_keys{"$schema", "comment"};

/// The entries of a scene object without what is ignored, each checked by itself; of a master_curve_file its lists.
/// @param folder that the name of such a file is relative to
/// @throws std::invalid_argument for an unknown key or a wrong value
std::vector<SceneEntry> scene_entries(const Json& object, const std::filesystem::path& folder,
                                      const std::string& place);

/// @throws std::invalid_argument naming the entry's place, if its key is none of a scene file
void refuse_unknown_key(const SceneEntry& entry);

/// Adds an entry as it is held. @throws std::invalid_argument if its input is among the entries
void add_entry(std::vector<SceneEntry>& entries, const SceneEntry& given);

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

/// A difference of two values of such an input, as a standard deviation is, in SI: one of temperatures has no origin.
/// @throws std::invalid_argument naming place, key, value and rule
double input_difference(const SceneEntry& entry, const InputKind& kind, Body body);

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
