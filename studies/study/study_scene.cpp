#include "studies/study/study_scene.hpp"

#include <optional>
#include <utility>

#include "core/scene/scene_input.hpp"
#include "studies/scene_io/master_curve_file.hpp"
#include "studies/scene_io/scene_overrides.hpp"
#include "studies/study/study_variants.hpp"
#include "studies/study/uncertain_inputs.hpp"
#include "studies/text/files.hpp"

namespace rollres {

CompleteScene complete_scene(const Json& object, const std::filesystem::path& file, const std::string& place) {
  const std::string rule = "must be the name of a scene file, or a scene";
  const Json& scene = needed(object, "scene", place, rule);
  if (scene.is_object()) {
    const std::string here = place + ": scene";
    return {with_master_curve(scene, file.parent_path(), here), here, !names_tables(scene)};
  }
  const std::filesystem::path named = file.parent_path() / needed_text(object, "scene", place, rule);
  return {with_master_curve(read_object(named.string()), named.parent_path(), named.string()), named.string()};
}

std::vector<SceneEntry> scene_entries_of(const Json& object, const std::filesystem::path& file,
                                         const std::string& place) {
  const CompleteScene scene = complete_scene(object, file, place);
  return scene_entries(scene.inputs, {}, scene.place);
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
    const bool chosen = any_of(group, [&](std::size_t axis) { return axes[axis].choice(); });
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
      if (find_input(entry.key)->optional) of_any.emplace_back(entry.key, input_value(entry, body_of(scene)));
  });
  for (const auto& [key, value] : of_any) assign_input(*first, key, value);
  return *first;
}

std::string standalone_text(Json study, const std::string& text, const CompleteScene& scene,
                            const std::filesystem::path& file) {
  bool stood_alone = scene.stood_alone && study == parse_object(text, file.string());  // no fit took its place in it
  for (const char* const varied : {"axes", "variables"})
    if (study.contains(varied) && inline_variants(study[varied], file.parent_path(), file.string() + ": " + varied))
      stood_alone = false;
  if (stood_alone) return text;
  study["scene"] = scene.inputs;
  return study.dump(2) + "\n";
}

std::string standalone_study(const std::filesystem::path& file) {
  const std::string text = whole_file(file, largest_json), place = file.string();
  Json study = parse_object(text, place);
  resolve_fit(study, file, place);
  return study.contains("scene") ? standalone_text(study, text, complete_scene(study, file, place), file) : text;
}

}  // namespace rollres
