#pragma once

#include <exception>
#include <string>

#include "core/scene/scene.hpp"
#include "core/scene/solution.hpp"

/// What `work` throws, or "nothing".
template <class Work>
std::string message_of(Work&& work) {
  try {
    work();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "nothing";
}

/// A scene that breaks no rule.
inline rollres::RollingScene plain_scene(double speed = 1.0, double load = 1e4) {
  rollres::RollingScene scene;
  scene.radius = 0.1;
  scene.layer_thickness = 0.01;
  scene.static_shear_modulus = 1e6;
  scene.stiffening = 2;
  scene.creep_time = 0.1;
  scene.friction_coefficient = 0.3;
  scene.speed = speed;
  scene.load = load;
  return scene;
}

/// A closed form in place of a solver: quick, and different for different scenes.
inline rollres::RollingSolution closed_form(const rollres::RollingScene& scene) {
  rollres::RollingSolution solution;
  solution.load = scene.load.value_or(1e9 * scene.approach.value_or(0));
  solution.rolling_resistance = 0.01 * solution.load * scene.speed / (1 + scene.speed * scene.speed);
  solution.rolling_resistance_coefficient = solution.rolling_resistance / solution.load;
  solution.contact_nodes = 31;
  solution.seconds = 1e-6;
  solution.method = scene.method;
  solution.status = rollres::Status::converged;
  return solution;
}
