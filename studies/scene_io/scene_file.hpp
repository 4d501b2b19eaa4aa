#pragma once

/// Scene files: one flat JSON object, its keys those of `visit_inputs`. A number is SI, or a text with a unit ("5 mm");
/// layer_thickness may be "infinite"; lists of them stand in [ ]; "master_curve_file" names a CSV file, relative to the
/// scene's, in place of the lists that it holds (master_curve_file.hpp); texts under "comment" and "$schema" are
/// ignored. Nothing else is accepted: every refusal is one line that names file, key, value and rule.

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/scene.hpp"

namespace rollres {

/// Reads a scene and replaces inputs by `overrides`, each "KEY=VALUE" as after `--set`. An override that gives one of
/// load and approach, or of spacing and tolerance, replaces the other; a drive drops what belongs to another drive.
/// @throws std::invalid_argument naming file (or --set), key, value and rule
/// @throws std::runtime_error if the file cannot be read
RollingScene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// The same for a text; `place` stands for the file in messages.
RollingScene parse_scene(std::string_view json, const std::string& place,
                         const std::vector<std::string>& overrides = {});

/// One of the paper's two scenes (Zehil and Gavin 2013, sections 5.1 and 5.2), kept inside the program: the files
/// paper_cylinder.json and paper_sphere.json of studies/examples.
struct PaperScene {
  std::string_view name;  ///< "paper_cylinder"
  std::string_view json;  ///< the file's text
};

std::span<const PaperScene> paper_scenes();

}  // namespace rollres
