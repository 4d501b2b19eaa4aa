#pragma once

/// The two examples of Zehil and Gavin (2013), sections 5.1 and 5.2, as scenes.

#include "core/scene/scene.hpp"

namespace rollres {

inline RollingScene paper_cylinder() {
  RollingScene scene;
  scene.indenter = Indenter::cylinder;
  scene.radius = 0.02;
  scene.layer_thickness = 0.005;
  scene.static_shear_modulus = 3e6;
  scene.stiffening = 1;
  scene.creep_time = 0.25;
  scene.speed = 0.05;
  scene.load = 20e3;
  scene.friction_coefficient = 0.2;
  scene.kinematics = Kinematics::printed;
  scene.spacing = 0.25e-3;
  return scene;
}

inline RollingScene paper_sphere() {
  RollingScene scene = paper_cylinder();
  scene.indenter = Indenter::sphere;
  scene.load = 150;
  return scene;
}

/// The sphere that nothing drives, with the consistent kinematics.
inline RollingScene free_paper_sphere() {
  RollingScene scene = paper_sphere();
  scene.kinematics = Kinematics::consistent;
  scene.drive = Drive::free;
  return scene;
}

inline RollingScene frictionless(RollingScene scene) {
  scene.friction_coefficient = 0;
  return scene;
}

inline RollingScene with_method(RollingScene scene, Method method) {
  scene.method = method;
  return scene;
}

}  // namespace rollres
