#pragma once

#include <cmath>

#include "core/scene/scene.hpp"

namespace rollres {

/// A cylinder of 1 m in radius on an elastic incompressible half-space, under the load of Hertz's half-width [m].
inline RollingScene cylinder_on_half_space(double half_width, double friction_coefficient, Drive drive) {
  RollingScene scene;
  scene.radius = 1;
  scene.layer_thickness = INFINITY;
  scene.material = MaterialModel::elastic;
  scene.static_shear_modulus = 1e6;
  scene.inertia = Inertia::off;
  scene.speed = 0.1;
  scene.load = M_PI * *scene.static_shear_modulus * half_width * half_width;
  scene.friction_coefficient = friction_coefficient;
  scene.drive = drive;
  return scene;
}

}  // namespace rollres
