#include "studies/stored/standalone_study.hpp"

#include <fstream>
#include <sstream>
#include <stdexcept>

#include "studies/scene_io/master_curve_file.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

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
