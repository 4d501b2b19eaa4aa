#include "core/sliding_limit.hpp"

#include <algorithm>
#include <cmath>

#include "core/nested_newton.hpp"

namespace rollres {

namespace {

/// Surplus of the drive's row [N] in the direction asked for, when the body turns so fast (+1) or so slowly (-1) that
/// the whole contact slides one way; NaN if that could not be solved.
double sliding_surplus(RollingScene scene, const SurfaceGrid& grid, double friction, int direction) {
  scene.friction_coefficient = friction;
  RollingScene sliding = scene;
  sliding.drive = Drive::rotation;
  sliding.driving_torque.reset();
  sliding.rotation_ratio = 1 + direction * 1e4;
  const ContactLevel level = solve_level(sliding, grid, nullptr, false);
  if (!level.outcome.converged) return RollingSolution::absent;
  const ContactProblem wanted(scene, level.problem->grid);
  const ContactUnknowns& x = level.outcome.unknowns;
  return direction * (wanted.drive(x.pressure, x.shear_x) - wanted.drive_target);
}

}  // namespace

SlidingLimit sliding_limit(const RollingScene& scene, const SurfaceGrid& half_grid) {
  bool known = true;
  for (const int direction : {1, -1}) {
    const double surplus = sliding_surplus(scene, half_grid, scene.friction_coefficient, direction);
    if (surplus < 0) return SlidingLimit::not_enough;
    known = known && !std::isnan(surplus);
  }
  return known ? SlidingLimit::enough : SlidingLimit::unknown;
}

double friction_needed(const RollingScene& scene, const SurfaceGrid& half_grid) {
  const double given = scene.friction_coefficient;
  double forward = sliding_surplus(scene, half_grid, given, 1);
  double backward = forward < 0 ? 0 : sliding_surplus(scene, half_grid, given, -1);
  if (std::isnan(forward) || std::isnan(backward)) return RollingSolution::absent;
  if (forward >= 0 && backward >= 0) return given;

  // The surplus is nearly linear in the coefficient.
  const int direction = forward < 0 ? 1 : -1;
  double low = given, low_value = direction > 0 ? forward : backward, high = given, high_value = low_value;
  for (int doubling = 0; doubling < 40 && high_value < 0; ++doubling) {
    low = high;
    low_value = high_value;
    high = 2 * high;
    high_value = sliding_surplus(scene, half_grid, high, direction);
  }
  for (int step = 0; step < 40 && high_value > 0 && high - low > 1e-6 * high; ++step) {
    // Regula falsi that keeps off the ends, but steps just beyond the root it expects.
    const double expected = -low_value / (high_value - low_value);
    const double middle = low + (high - low) * std::clamp(expected + (step % 2 == 0 ? 1e-4 : -1e-4), 1e-3, 0.999);
    const double value = sliding_surplus(scene, half_grid, middle, direction);
    if (std::isnan(value)) return RollingSolution::absent;
    (value < 0 ? low : high) = middle;
    (value < 0 ? low_value : high_value) = value;
  }
  return high_value >= 0 ? high : RollingSolution::absent;
}

}  // namespace rollres
