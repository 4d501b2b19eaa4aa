#include "core/rolling_contact.hpp"

#include <chrono>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "core/evidence.hpp"
#include "core/grid_choice.hpp"
#include "core/nested_newton.hpp"

namespace rollres {

namespace {

/// Nodes in contact beyond which a tolerance is given up.
constexpr int most_nodes_2d = 20000, most_nodes_3d = 60000;

RollingSolution solve_newton(const RollingScene& scene) {
  const bool sphere = scene.indenter == Indenter::sphere;
  const auto estimate = [](const NestedOutcome& nested) {
    const double finest = nested.finest.rolling_resistance;
    return std::abs(nested.coarser_resistance / finest - 1);
  };
  std::function<bool(const NestedOutcome&)> finer;
  if (scene.tolerance)
    finer = [&](const NestedOutcome& nested) {
      int nodes = 0;
      for (const Zone zone : nested.finest.outcome.zone) nodes += zone != Zone::free;
      if (sphere) nodes *= 2;
      return !(estimate(nested) <= *scene.tolerance) &&
             (sphere ? 4 : 2) * nodes <= (sphere ? most_nodes_3d : most_nodes_2d);
    };
  const double spacing = scene.spacing.value_or(default_spacing(scene));
  const NestedOutcome nested = solve_nested(scene, spacing, finer);
  RollingSolution solution;
  if (nested.status == Status::converged) {
    const ContactLevel& level = nested.finest;
    if (level.problem->friction) {
      solution = summarise(*level.problem, *level.influence, level.outcome.unknowns, level.outcome.zone);
    } else {
      const InfluenceOperator all_components(scene, *level.table, level.problem->grid, true);
      solution = summarise(*level.problem, all_components, level.outcome.unknowns, level.outcome.zone);
    }
    solution.error_estimate = estimate(nested);
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
  solution.iterations = nested.finest.outcome.iterations;
  return solution;
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
  RollingSolution solution = solve_newton(scene);
  solution.method = scene.method;
  if (solution.status == Status::converged) {
    solution.model = model_of(scene, solution);
    for (std::string& warning : warnings_for(scene, solution)) solution.warnings.push_back(std::move(warning));
  }
  solution.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return solution;
}

}  // namespace rollres
