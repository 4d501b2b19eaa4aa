#pragma once

#include <cmath>

#include "studies/optimise/design.hpp"
#include "tests/plain_scene.hpp"

/// A closed form in place of a solver, over x = log20(H / 1 mm) and y = log10(G0 / 1 MPa) in the unit box:
/// ln R = (x - 0.3)^2 + (y - 0.6)^2 / 2 + 0.4 (x - 0.3) (y - 0.6), ln p = x + y - 1.2 (p in Pa).
struct Bowl {
  static double x(const rollres::RollingScene& scene) {
    return std::log(scene.layer_thickness / 1e-3) / std::log(20.0);
  }
  static double y(const rollres::RollingScene& scene) { return std::log10(*scene.static_shear_modulus / 1e6); }
  static double log_resistance(double x, double y) {
    return (x - 0.3) * (x - 0.3) + 0.5 * (y - 0.6) * (y - 0.6) + 0.4 * (x - 0.3) * (y - 0.6);
  }
  static rollres::RollingSolution solve(const rollres::RollingScene& scene) {
    rollres::RollingSolution solution = closed_form(scene);
    solution.rolling_resistance = std::exp(log_resistance(x(scene), y(scene)));
    solution.peak_pressure = std::exp(x(scene) + y(scene) - 1.2);
    return solution;
  }
};

/// Minimise R over the box; with a constraint if one is given.
inline rollres::DesignProblem bowl_problem(const std::vector<std::string>& constraints = {}) {
  using namespace rollres;
  RollingScene scene = plain_scene();
  scene.layer_thickness = 5e-3;
  scene.static_shear_modulus = 2e6;
  DesignProblem problem{.name = "bowl",
                        .scenes = {{scene, 1}},
                        .variables = variables_of(
                            scene, {{"layer_thickness", 1e-3, 20e-3, true}, {"static_shear_modulus", 1e6, 10e6, true}}),
                        .start = {5e-3, 2e6},
                        .goal = {Formula("rolling_resistance", FormulaNames::inputs_and_outputs)}};
  for (const std::string& text : constraints)
    problem.constraints.emplace_back(text, FormulaNames::inputs_and_outputs, scene.indenter);
  return problem;
}
