#pragma once

#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/core/paper_scenes.hpp"

namespace rollres {

/// The cylinder of Zehil and Gavin with continuous edges.
inline RollingScene gridless_cylinder(double friction) {
  RollingScene scene = paper_cylinder();
  scene.spacing.reset();
  scene.friction_coefficient = friction;
  return scene;
}

/// The solution of a scene that the spectral method must solve, with every law of contact held.
inline RollingSolution spectral(const RollingScene& scene) {
  const RollingSolution solution = solve(scene);
  INFO(solution.reason << solution.model);
  REQUIRE(solution.method == Method::spectral);
  REQUIRE(solution.status == Status::converged);
  CHECK(solution.law_violation < 1e-8);
  return solution;
}

}  // namespace rollres
