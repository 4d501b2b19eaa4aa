#include "studies/study/base_scene.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace rollres {

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
