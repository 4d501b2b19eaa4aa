#include "studies/study/predicted_cost.hpp"

#include <algorithm>
#include <cmath>

#include "core/estimate/grid_choice.hpp"
#include "core/model/scene_rules.hpp"

namespace rollres {

namespace {

double cylinder_on_grid(Method method, double cells, bool friction) {
  if (method == Method::newton) return friction ? 4.3e-5 * std::pow(cells, 0.9) : 2.4e-5 * (cells + 1);
  return friction ? 1.7e-6 * (std::pow(cells, 1.7) + 100) : 1.5e-6 * (std::pow(cells, 1.5) + 100);
}

double sphere_on_grid(Method method, double cells, bool friction) {
  const double cube = cells * cells * cells;
  if (method != Method::newton_dense && method != Method::active_set)
    return friction ? 1.15e-4 * (std::pow(cells, 1.8) + 10) : 9.2e-5 * (std::pow(cells, 1.5) + 3);
  const double seconds =
      1.1e-5 * cube + (method == Method::newton_dense ? 2.2e-7 * cube * cells * cells : 3.4e-8 * cube * cube);
  return 1e-3 + (friction ? 1.0 : 0.25) * seconds;
}

}  // namespace

double predicted_seconds(const RollingScene& scene) {
  const Method method = resolved_method(scene);
  const bool friction = scene.friction_coefficient > 0;
  if (method == Method::spectral) return friction ? 3e-3 : 0.7e-3;
  if (method == Method::finite_strain)
    return (friction ? 2 : 1) * 0.06 * std::pow(std::clamp(scene.tolerance.value_or(1e-3), 1e-5, 1e-2), -0.25);
  const bool sphere = dimension_of(scene.indenter) == 3;
  if (scene.tolerance && !scene.spacing) {
    const double tolerance = std::clamp(*scene.tolerance, 1e-6, 0.02);
    if (sphere) return (friction ? 0.33 : 0.06) * std::pow(1.5e-3 / tolerance, 0.7);
    return friction ? 5e-5 * (std::pow(tolerance, -0.8) + 100) : 1.2e-4 * std::pow(tolerance, -0.5);
  }
  const double spacing = scene.spacing ? *scene.spacing : default_spacing(scene);
  const double cells = std::clamp(std::min(estimate_contact(scene).half_width, 0.7 * scene.radius) / spacing, 2.0, 2e3);
  return sphere ? sphere_on_grid(method, cells, friction) : cylinder_on_grid(method, cells, friction);
}

std::vector<double> predicted_seconds(const StudyPlan& plan) {
  std::vector<double> seconds;
  seconds.reserve(plan.size());
  plan.for_each([&](std::size_t, const RollingScene& scene) { seconds.push_back(predicted_seconds(scene)); });
  return seconds;
}

}  // namespace rollres
