#include "studies/study_scene.hpp"

#include <algorithm>
#include <optional>

#include "studies/study_keys.hpp"

namespace rollres {

namespace {

std::vector<SceneEntry> own_entries(const Json& study, const std::filesystem::path& file, const std::string& place) {
  const std::string rule = "must be the name of a scene file, or a scene";
  const Json& scene = needed(study, "scene", place, rule);
  if (scene.is_object()) return scene_entries(scene, place + ": scene");
  const std::string path = (file.parent_path() / needed_text(study, "scene", place, rule)).string();
  return scene_entries(read_object(path), path);
}

std::vector<SceneEntry> set_entries(const Json& study, const std::string& place, const std::vector<GivenAxis>& varied) {
  const auto set = study.find("set");
  if (set == study.end()) return {};
  if (!set->is_object()) refuse(place, "set", *set, "must be an object { ... } of inputs");
  std::vector<SceneEntry> entries;
  for (const auto& [key, value] : set->items()) {
    if (!find_input(key)) refuse(place + ": set", key, value, unknown("unknown key", input_keys(), key));
    for (const GivenAxis& axis : varied)
      if (axis.key == key) refuse(place + ": set", key, value, "is an axis of the study too");
    entries.push_back({key, value, place + ": set"});
  }
  return entries;
}

}  // namespace

std::vector<SceneEntry> study_entries(const Json& study, const std::filesystem::path& file, const std::string& place,
                                      const std::vector<GivenAxis>& varied) {
  return overridden(own_entries(study, file, place), set_entries(study, place, varied));
}

RollingScene base_scene(const std::vector<SceneEntry>& entries, const std::vector<GivenAxis>& axes,
                        const std::string& place) {
  const auto size_of = [&](const std::vector<std::size_t>& group) {
    const bool chosen = std::any_of(group.begin(), group.end(), [&](std::size_t axis) { return axes[axis].choice(); });
    return chosen ? axes[group.front()].size() : 1;
  };
  std::optional<RollingScene> first;
  std::vector<SceneEntry> of_any;
  for_each_combination(axes, size_of, [&](const std::vector<std::size_t>& at) {
    std::vector<SceneEntry> chosen;
    for (std::size_t i = 0; i < axes.size(); ++i)
      chosen.push_back(axes[i].values[axes[i].positions.empty() ? at[i] : 0]);
    const std::vector<SceneEntry> all = overridden(entries, chosen);
    const RollingScene scene = unchecked_scene_from(all, place);
    if (!first) first = scene;
    for (const SceneEntry& entry : all)
      if (find_input(entry.key)->optional) of_any.push_back(entry);
  });
  for (const SceneEntry& entry : of_any) assign_input(*first, entry.key, input_value(entry, first->indenter));
  return *first;
}

}  // namespace rollres
