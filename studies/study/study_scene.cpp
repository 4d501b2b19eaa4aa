#include "studies/study/study_scene.hpp"

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

}  // namespace rollres
