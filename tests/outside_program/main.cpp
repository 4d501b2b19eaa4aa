#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <rollres/core/rolling_contact.hpp>

/// Prints the rolling resistance [N/m] of the paper's cylinder; its only word is the number expected.
int main(int, char** words) {
  rollres::RollingScene scene;
  scene.radius = 0.02;
  scene.layer_thickness = 0.005;
  scene.static_shear_modulus = 3e6;
  scene.stiffening = 1;
  scene.creep_time = 0.25;
  scene.speed = 0.05;
  scene.load = 20e3;
  scene.friction_coefficient = 0.2;
  scene.spacing = 0.25e-3;
  scene.kinematics = rollres::Kinematics::printed;
  const rollres::RollingSolution solution = rollres::solve(scene);
  std::printf("%.17g\n", solution.rolling_resistance);
  return std::abs(solution.rolling_resistance / std::atof(words[1]) - 1) < 1e-12 ? EXIT_SUCCESS : EXIT_FAILURE;
}
