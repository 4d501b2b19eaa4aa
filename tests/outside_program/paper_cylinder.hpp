#pragma once

#include <rollres/core/scene.hpp>

/// The cylinder of Zehil and Gavin (2013), section 5.1, as another program writes it.
inline rollres::RollingScene paper_cylinder() {
  rollres::RollingScene scene;
  scene.radius = 0.02;
  scene.layer_thickness = 0.005;
  scene.static_shear_modulus = 3e6;
  scene.stiffening = 1;
  scene.creep_time = 0.25;
  scene.speed = 0.05;
  scene.load = 20e3;
  scene.friction_coefficient = 0.2;
  return scene;
}
