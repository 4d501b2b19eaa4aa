#include "core/rolling_contact.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "core/active_set.hpp"
#include "core/evidence.hpp"
#include "core/grid_choice.hpp"
#include "core/nested_newton.hpp"

namespace rollres {

namespace {

/// Nodes in contact beyond which a tolerance is given up.
constexpr int most_nodes_2d = 20000, most_nodes_3d = 60000;

RollingSolution solve_newton(const RollingScene& scene) {
  const bool sphere = scene.indenter == Indenter::sphere;
  std::function<bool(const NestedOutcome&)> finer;
  if (scene.tolerance)
    finer = [&](const NestedOutcome& nested) {
      const std::vector<Zone>& zone = nested.finest.outcome.zone;
      const auto nodes =
          (sphere ? 2 : 1) * (zone.end() - zone.begin() - std::count(zone.begin(), zone.end(), Zone::free));
      return !(nested.error_estimate() <= *scene.tolerance) &&
             (sphere ? 4 : 2) * nodes <= (sphere ? most_nodes_3d : most_nodes_2d);
    };
  const NestedOutcome nested = solve_nested(scene, scene.spacing.value_or(default_spacing(scene)), finer);
  RollingSolution solution;
  if (nested.status == Status::converged) {
    const ContactLevel& level = nested.finest;
    if (level.problem->friction) {
      solution = summarise(*level.problem, *level.influence, level.outcome.unknowns, level.outcome.zone);
    } else {
      const InfluenceOperator all_components(scene, *level.table, level.problem->grid, true);
      solution = summarise(*level.problem, all_components, level.outcome.unknowns, level.outcome.zone);
    }
    solution.error_estimate = nested.error_estimate();
    if (scene.tolerance && !(solution.error_estimate <= *scene.tolerance)) {
      std::ostringstream text;
      text << "the tolerance " << *scene.tolerance << " was not reached with " << solution.contact_nodes
           << " nodes: estimated error " << solution.error_estimate;
      solution.warnings.push_back(text.str());
    }
  }
  solution.status = nested.status;
  solution.reason = nested.reason;
  solution.friction_needed = nested.friction_needed;
  solution.friction_borne = nested.friction_borne;
  solution.iterations = nested.finest.outcome.iterations;
  return solution;
}

/// Unknowns on rows y >= 0 from those on the whole grid; `asymmetry` is the largest difference to the mirror image over
/// the largest pressure.
ContactUnknowns upper_half(const ContactState& state, const SurfaceGrid& half, bool sphere, double& asymmetry) {
  ContactUnknowns unknowns;
  unknowns.approach = state.approach;
  unknowns.rotation_ratio = std::isnan(state.rotation_ratio) ? 0 : state.rotation_ratio;
  const double scale = state.pressure.cwiseAbs().maxCoeff();
  const auto keep = [&](const Vector& whole, double parity) {
    if (!sphere || whole.size() == 0) return whole;
    const Eigen::Index size = half.size();
    const Vector upper = whole.tail(size);
    asymmetry = std::max(asymmetry, (mirrored(half, true, upper, parity) - whole).cwiseAbs().maxCoeff() / scale);
    return upper;
  };
  unknowns.pressure = keep(state.pressure, 1);
  unknowns.shear_x = keep(state.shear_x, 1);
  unknowns.shear_y = keep(state.shear_y, -1);
  return unknowns;
}

/// The paper's method on one grid, which grows until the contact keeps clear of its border.
RollingSolution solve_paper(const RollingScene& scene) {
  const bool sphere = scene.indenter == Indenter::sphere;
  const double spacing = scene.spacing.value_or(default_spacing(scene));
  double half_width = std::min(1.3 * estimate_contact(scene).half_width + 2 * spacing, widest_window(scene));
  for (;; half_width = std::min(1.4 * half_width, widest_window(scene))) {
    const SurfaceGrid half = window(scene.indenter, spacing, half_width);
    const InfluenceTable table = influence_table(scene, mirrored(half, sphere));
    const ContactState state = solve_active_set(scene, table, mirrored(half, sphere));
    if (state.reached_border && half_width < widest_window(scene)) continue;
    RollingSolution solution;
    solution.status = state.status;
    solution.reason = state.reason;
    solution.friction_needed = state.friction_needed;
    if (state.status == Status::converged) {
      double asymmetry = 0;
      const ContactUnknowns unknowns = upper_half(state, half, sphere, asymmetry);
      const std::vector<Zone> zone(state.zone.end() - half.size(), state.zone.end());
      const ContactProblem problem(scene, half);
      const InfluenceOperator influence(scene, table, half, true);
      solution = summarise(problem, influence, unknowns, zone);
      solution.law_violation = std::max(solution.law_violation, asymmetry);
      solution.status = state.status;
    }
    solution.iterations = state.iterations;
    return solution;
  }
}

}  // namespace

RollingSolution solve(const RollingScene& scene) {
  const auto begin = std::chrono::steady_clock::now();
  const std::vector<std::string> broken = check(scene);
  if (!broken.empty()) {
    std::string message = broken.front();
    for (std::size_t i = 1; i < broken.size(); ++i) message += "; " + broken[i];
    throw std::invalid_argument(message);
  }
  RollingSolution solution = scene.method == Method::active_set ? solve_paper(scene) : solve_newton(scene);
  solution.method = scene.method;
  if (solution.status == Status::converged) {
    solution.model = model_of(scene, solution);
    for (std::string& warning : warnings_for(scene, solution)) solution.warnings.push_back(std::move(warning));
  }
  solution.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return solution;
}

}  // namespace rollres
