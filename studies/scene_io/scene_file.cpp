#include "studies/scene_io/scene_file.hpp"

#include "studies/scene_io/scene_entries.hpp"
#include "studies/scene_io/scene_overrides.hpp"
#include "studies/text/file_kind.hpp"

namespace rollres {

namespace {

RollingScene scene_with(const Json& object, const std::filesystem::path& folder, const std::string& place,
                        const std::vector<std::string>& overrides) {
  require_kind(FileKind::scene, object, place);
  const std::vector<SceneEntry> own = scene_entries(without_replaced_tables(object, overrides), folder, place);
  if (overrides.empty()) return scene_from(own, place);
  return scene_from(overridden(own, override_entries(overrides)), place + " with --set");
}

constexpr PaperScene scenes[] = {
#include "paper_scenes.inc"
};

}  // namespace

RollingScene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  return scene_with(read_object(file.string()), file.parent_path(), file.string(), overrides);
}

RollingScene parse_scene(std::string_view json, const std::string& place, const std::vector<std::string>& overrides) {
  return scene_with(parse_object(json, place), {}, place, overrides);
}

std::span<const PaperScene> paper_scenes() { return scenes; }

}  // namespace rollres
