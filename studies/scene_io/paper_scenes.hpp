#pragma once

/// The paper's two scenes (Zehil and Gavin 2013, sections 5.1 and 5.2), kept inside the program: the files
/// paper_cylinder.json and paper_sphere.json of studies/examples.

#include <span>
#include <string_view>

namespace rollres {

struct PaperScene {
  std::string_view name;  ///< "paper_cylinder"
  std::string_view json;  ///< as of scene_file.hpp
};

std::span<const PaperScene> paper_scenes();

}  // namespace rollres
