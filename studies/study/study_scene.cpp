#include "studies/study/study_scene.hpp"

#include <algorithm>
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "core/scene/scene_input.hpp"
#include "studies/scene_io/master_curve_file.hpp"
#include "studies/text/strict_json.hpp"

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
  return replacing_entries(*set, place + ": set");
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

std::string standalone_study(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::ostringstream text;
  if (!in || !(text << in.rdbuf())) throw std::runtime_error(file.string() + ": cannot be read");
  Json study = parse_object(text.str(), file.string());
  const auto scene = study.find("scene");
  if (scene == study.end()) return text.str();
  std::filesystem::path scene_file = file;
  const std::string key(master_curve_key);
  if (scene->is_string()) {
    scene_file = file.parent_path() / scene->get<std::string>();
    *scene = read_object(scene_file.string());
  } else if (!scene->contains(key)) {
    return text.str();
  }
  *scene = with_master_curve(*scene, scene_file.parent_path(), scene_file.string());
  return study.dump(2) + "\n";
}

}  // namespace rollres
