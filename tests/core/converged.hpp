#pragma once

#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"

/// The solution of a scene that must have one, with every law of contact held.
inline rollres::RollingSolution converged(const rollres::RollingScene& scene) {
  rollres::RollingSolution solution = rollres::solve(scene);
  INFO(solution.reason);
  REQUIRE(solution.status == rollres::Status::converged);
  CHECK(solution.law_violation < 1e-8);
  return solution;
}
