#include "studies/study/study_scene.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/scene/scene_input.hpp"

namespace rollres {

std::vector<SceneEntry> scene_entries_of(const Json& object, const std::filesystem::path& file,
                                         const std::string& place) {
  const Json& scene = needed(object, "scene", place, "must be the name of a scene file, or a scene");
  if (scene.is_object()) return scene_entries(scene, file.parent_path(), place + ": scene");
  if (!scene.is_string() || scene.get_ref<const std::string&>().empty())
    refuse(place, "scene", scene, "must be the name of a scene file, or a scene");
  const std::filesystem::path path = file.parent_path() / scene.get<std::string>();
  return scene_entries(read_object(path.string()), path.parent_path(), path.string());
}

std::vector<SceneEntry> set_entries(const Json& object, const std::string& place) {
  const auto set = object.find("set");
  if (set == object.end()) return {};
  if (!set->is_object()) refuse(place, "set", *set, "must be an object { ... } of inputs");
  std::vector<SceneEntry> entries;
  for (const auto& [key, value] : set->items()) {
    if (!find_input(key)) refuse(place + ": set", key, value, unknown("unknown key", keys_like(key), key));
    entries.push_back({key, value, place + ": set"});
  }
  return entries;
}

RollingScene base_scene(const std::vector<SceneEntry>& entries, const std::vector<GivenAxis>& axes,
                        const std::string& place) {
  const auto size_of = [&](const std::vector<std::size_t>& group) {
    const bool chosen = std::any_of(group.begin(), group.end(), [&](std::size_t axis) { return axes[axis].choice(); });
    return chosen ? axes[group.front()].size() : 1;
  };
  std::optional<RollingScene> first;
  std::vector<std::pair<std::string, InputValue>> of_any;
  for_each_combination(axes, size_of, [&](const std::vector<std::size_t>& at) {
    std::vector<SceneEntry> chosen;
    for (std::size_t i = 0; i < axes.size(); ++i)
      chosen.push_back(axes[i].values[axes[i].positions.empty() ? at[i] : 0]);
    const std::vector<SceneEntry> all = overridden(entries, chosen);
    const RollingScene scene = unchecked_scene_from(all, place);
    if (!first) first = scene;
    for (const SceneEntry& entry : all)
      if (find_input(entry.key)->optional) of_any.emplace_back(entry.key, input_value(entry, scene.indenter));
  });
  for (const auto& [key, value] : of_any) assign_input(*first, key, value);
  return *first;
}

}  // namespace rollres
