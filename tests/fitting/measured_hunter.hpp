#pragma once

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "core/reference/reference_hunter.hpp"
#include "fitting/fit/closed_form_start.hpp"
#include "fitting/fit/fit.hpp"
#include "fitting/fit/resistance_fit.hpp"
#include "tests/plain_scene.hpp"

/// Hunter's closed form in place of a solver.
inline rollres::RollingSolution hunter_resistance(const rollres::RollingScene& scene) {
  rollres::RollingSolution solution;
  solution.rolling_resistance = rollres::hunter_line(scene.radius, *scene.load, *scene.static_shear_modulus,
                                                     scene.stiffening, scene.creep_time, scene.speed)
                                    .rolling_resistance;
  solution.status = rollres::Status::converged;
  return solution;
}

/// An estimate in a microsecond, as smooth as Hunter's on a half-space, in place of a solver.
inline rollres::RollingSolution quick_resistance(const rollres::RollingScene& scene) {
  rollres::RollingSolution solution;
  solution.rolling_resistance = rollres::estimated_resistance(scene);
  solution.status = rollres::Status::converged;
  return solution;
}

/// A cylinder of radius 0.1 m on a half-space of G0 = 1 MPa, f = 2, tau = 0.1 s.
inline rollres::RollingScene half_space_scene(double speed, double load) {
  rollres::RollingScene scene = plain_scene(speed, load);
  scene.layer_thickness = std::numeric_limits<double>::infinity();
  scene.friction_coefficient = 0;
  return scene;
}

/// Measured values of that material, each off by a normal error of the relative deviation `noise`.
/// @param deviation what the data say of it, relative
inline std::vector<rollres::MeasuredScene> measured(const rollres::Evaluate& evaluate,
                                                    const std::vector<double>& speeds, const std::vector<double>& loads,
                                                    double noise = 0, std::uint64_t seed = 1, double deviation = 0.02) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<rollres::MeasuredScene> scenes;
  for (const double load : loads)
    for (const double speed : speeds) {
      const rollres::RollingScene scene = half_space_scene(speed, load);
      const double exact = evaluate(scene).rolling_resistance;
      const double value = exact * (1 + noise * normal(random));
      scenes.push_back({scene, {value, deviation * exact, "row " + std::to_string(scenes.size() + 1)}});
    }
  return scenes;
}

inline std::vector<double> spread_speeds(double from, double to, int count) {
  std::vector<double> speeds;
  for (int i = 0; i < count; ++i) speeds.push_back(from * std::pow(to / from, i / (count - 1.0)));
  return speeds;
}

/// G0, f and tau, started off their values.
inline std::vector<rollres::FittedInput> zener_inputs() {
  return {{{"static_shear_modulus"}, 2e6}, {{"stiffening"}, 1.0}, {{"creep_time"}, 0.03}};
}
