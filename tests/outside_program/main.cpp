#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <rollres/core/rolling_contact.hpp>

#include "paper_cylinder.hpp"

/// Prints the rolling resistance [N/m] of the paper's cylinder; its only word is the number expected.
int main(int, char** words) {
  rollres::RollingScene scene = paper_cylinder();
  scene.spacing = 0.25e-3;
  scene.kinematics = rollres::Kinematics::printed;
  const rollres::RollingSolution solution = rollres::solve(scene);
  std::printf("%.17g\n", solution.rolling_resistance);
  return std::abs(solution.rolling_resistance / std::atof(words[1]) - 1) < 1e-12 ? EXIT_SUCCESS : EXIT_FAILURE;
}
