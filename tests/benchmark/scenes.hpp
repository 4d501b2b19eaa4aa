#pragma once

/// The scenes that are timed, and their names.

#include <cmath>
#include <limits>
#include <string>

#include "core/estimate/grid_choice.hpp"
#include "core/newton/contact_problem.hpp"
#include "studies/scene_io/scene_file.hpp"

namespace rollres::timed {

/// Zehil and Gavin (2013), section 5.2, on a grid of so many metres.
inline RollingScene paper_sphere(double spacing) {
  RollingScene scene = read_scene(std::string(ROLLRES_SOURCE_DIR) + "/studies/examples/paper_sphere.json");
  scene.spacing = spacing;
  return scene;
}

/// An elastic sphere that rolls on a half-space under a given traction, half of what friction can give, so many nodes
/// across the radius of the contact a = (3 P R / 16 G)^(1/3).
inline RollingScene elastic_sphere(double nodes_per_radius) {
  RollingScene scene;
  scene.indenter = Indenter::sphere;
  scene.radius = 0.02;
  scene.layer_thickness = std::numeric_limits<double>::infinity();
  scene.material = MaterialModel::elastic;
  scene.static_shear_modulus = 3e6;
  scene.speed = 1;
  scene.load = 50;
  scene.friction_coefficient = 0.25;
  scene.drive = Drive::torque;
  scene.driving_torque = 0.5 * scene.friction_coefficient * *scene.load * scene.radius;
  scene.spacing = std::cbrt(3 * *scene.load * scene.radius / (16 * *scene.static_shear_modulus)) / nodes_per_radius;
  return scene;
}

/// Half grid that covers the contact of a scene and a tenth of it more.
inline SurfaceGrid grid_of(const RollingScene& scene) {
  return window(dimension_of(scene.indenter), *scene.spacing, 1.1 * estimate_contact(scene).half_width);
}

}  // namespace rollres::timed
