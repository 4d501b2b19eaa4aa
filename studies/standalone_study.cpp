#include "studies/standalone_study.hpp"

#include <fstream>
#include <sstream>
#include <stdexcept>

#include "studies/strict_json.hpp"

namespace rollres {

std::string standalone_study(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::ostringstream text;
  if (!in || !(text << in.rdbuf())) throw std::runtime_error(file.string() + ": cannot be read");
  Json study = parse_object(text.str(), file.string());
  const auto scene = study.find("scene");
  if (scene == study.end() || !scene->is_string()) return text.str();
  *scene = read_object((file.parent_path() / scene->get<std::string>()).string());
  return study.dump(2) + "\n";
}

}  // namespace rollres
