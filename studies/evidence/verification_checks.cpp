#include "studies/evidence/verification_checks.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "studies/scene_io/scene_file.hpp"

namespace rollres::verification {

RollingSolution Checks::solve(const RollingScene& scene) {
  RollingSolution solution;
  try {
    solution = evaluate_(scene);
  } catch (const std::exception& error) {
    solution.reason = error.what();
  }
  if (solution.status == Status::converged) return solution;
  reason_ = std::string(name_of(solution.status)) + (solution.reason.empty() ? "" : ": ") + solution.reason;
  return {};
}

void Checks::add(VerificationRow row) {
  if (std::isnan(row.got)) row.reason = reason_;
  rows_.push_back(std::move(row));
}

RollingScene paper_scene(std::string_view name) {
  for (const PaperScene& scene : paper_scenes())
    if (scene.name == name) return parse_scene(scene.json, std::string(name));
  throw std::logic_error("no such scene of the paper");
}

RollingScene without_grid(RollingScene scene) {
  scene.spacing.reset();
  return scene;
}

RollingScene on_half_space(Indenter indenter) {
  RollingScene scene;
  scene.indenter = indenter;
  scene.radius = unit_radius;
  scene.layer_thickness = std::numeric_limits<double>::infinity();
  scene.static_shear_modulus = shear_modulus;
  scene.material = MaterialModel::elastic;
  scene.kinematics = Kinematics::printed;  // the slip of a flat surface, as in the closed forms
  scene.speed = 1;
  scene.load = dimension_of(indenter) == 2 ? M_PI * shear_modulus * line_width * line_width / unit_radius
                                           : 16 * shear_modulus * std::pow(sphere_width, 3) / (3 * unit_radius);
  return scene;
}

}  // namespace rollres::verification
