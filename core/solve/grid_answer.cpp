#include "core/solve/grid_answer.hpp"

#include <algorithm>
#include <cmath>

#include "core/estimate/grid_choice.hpp"
#include "core/messages/message_text.hpp"
#include "core/model/stated_error.hpp"
#include "core/newton/grid_solution.hpp"
#include "core/newton/nested_newton.hpp"
#include "core/numerics/solution_limits.hpp"

namespace rollres {

bool has_coarse_grid(const ContactModel& model) {
  return !model.spacing && (model.dimension == 3 || model.adhesion_threshold == 0);
}

namespace {

/// Cells on the half-width of a sphere's contact, by steps of sqrt(2). No sum of two squares lies within 1.2 % of the
/// square of the usual number (step 0), nor of half and of a quarter of it (steps -1 and -2): where the contact is an
/// ellipse, no node is near its edge.
double tied_cells(int step) {
  constexpr double usual = 19.532;
  return usual * std::exp2(0.5 * step);
}
constexpr int coarsest_step = -2, most_steps = 3;  // where a tolerance begins; at a time, as coarse grids tell little

/// A step, or the one whose cells tell the hollows of a profile, up to a limit.
int step_for(const ContactModel& model, int step) {
  constexpr int most = 5;
  const double cells = cells_for_hollows(model);
  while (step < most && tied_cells(step) < cells) ++step;
  return step;
}

/// The same of a cylinder.
constexpr double cells_of_line = 60;

GridSeries grids_of(const ContactModel& model) {
  if (!has_coarse_grid(model)) return fixed_grids(model, model.spacing.value_or(default_spacing(model)));
  return model.dimension == 3 ? tied_grids(model, tied_cells(step_for(model, 0))) : tied_lines(model, cells_of_line);
}

/// A larger violation of the laws, in scenes far from any layer's, is mended by factorising systems of up to so many
/// nodes.
constexpr int factorisable_nodes = 1000;

/// Of a solution on one grid beyond which no finer one is tried for a tolerance: GMRES vectors times unknowns, some
/// seconds.
constexpr double most_work = 2e7;

/// How many times finer in nodes than its finest grid a solution can be had for a tolerance's sake.
double room_for_nodes(const NestedOutcome& nested, int most_nodes) {
  const NewtonOutcome& outcome = nested.finest.outcome;
  const std::vector<Zone>& zone = outcome.zone;
  const int images = nested.finest.problem->grid.folded ? 2 : 1;
  const auto nodes =
      static_cast<double>(images * (zone.end() - zone.begin() - std::count(zone.begin(), zone.end(), Zone::free)));
  if (nodes * outcome.krylov_iterations > most_work) return 0;
  return most_nodes / nodes;
}

/// A sphere whose grid is tied to its contact: as many cells as the estimate on a coarser grid asks for.
NestedOutcome solve_sphere_to_tolerance(const ContactModel& model, int most_nodes) {
  int step = step_for(model, coarsest_step);
  NestedOutcome found = solve_nested(model, tied_grids(model, tied_cells(step)));
  if (found.status != Status::converged) {
    step = step_for(model, 0);
    found = solve_nested(model, tied_grids(model, tied_cells(step)));
  }
  NestedOutcome best;  // of the grids before, where a finer one does not always tell more
  while (found.status == Status::converged) {
    const double room = room_for_nodes(found, most_nodes), missed = found.error_estimate() / *model.tolerance;
    if (missed <= 1 || room < 2) break;
    // Nodes double with each step, and the error falls about as they grow.
    const double wanted = std::min(std::ceil(std::log2(missed)), std::floor(std::log2(room)));
    step += static_cast<int>(std::clamp(wanted, 1.0, static_cast<double>(most_steps)));
    try {
      NestedOutcome finer = solve_nested(model, tied_grids(model, tied_cells(step)));
      if (finer.status != Status::converged) break;
      best = better_of(std::move(found), std::move(best));
      found = std::move(finer);
    } catch (const BeyondLimits& limit) {
      found.reason = limit.what();
      break;
    }
  }
  return better_of(std::move(found), std::move(best));
}

/// @param most_nodes in contact; beyond, a tolerance is given up
NestedOutcome solve_nested_to_tolerance(const ContactModel& model, int most_nodes) {
  if (!model.tolerance) return solve_nested(model, grids_of(model));
  if (model.dimension == 3) return solve_sphere_to_tolerance(model, most_nodes);
  return solve_nested(model, grids_of(model), [&](const NestedOutcome& nested) {
    return !(nested.error_estimate() <= *model.tolerance) && room_for_nodes(nested, most_nodes) >= 2;
  });
}

/// Puts what tied grids tend to into a solution: R_r, the rotation, the axial force, and what drives the body with
/// them.
void take_limits(const NestedOutcome& nested, RollingSolution& solution) {
  const ContactModel& model = nested.finest.problem->model;
  if (model.friction_coefficient == 0) return;
  const HalvingLimit resistance = nested.limit(&GridNumbers::resistance),
                     turning = nested.limit(&GridNumbers::rotation_ratio),
                     axial = nested.limit(&GridNumbers::side_force);
  if (resistance.share == 0 && turning.share == 0 && axial.share == 0) return;
  const double tends_to = solution.rolling_resistance + resistance.to_come;
  solution.rotation_ratio += turning.to_come;
  solution.rotation_speed = solution.rotation_ratio * model.speed / model.radius;
  solution.rolling_resistance =
      solution.driving_force + solution.driving_torque * solution.rotation_ratio / model.radius;
  if (model.skewed()) {
    solution.axial_force += axial.to_come;
    solution.rolling_resistance -= model.skew * solution.axial_force;
  }
  add_resistance(model, tends_to - solution.rolling_resistance, solution);
  if (resistance.share > 0.01)
    solution.model += message_text("; rolling resistance that the grids tend to, share ", resistance.share);
}

/// Under a cylinder that is pressed in by a given way, friction changes the load with each halving of the cells as much
/// as with all that follow, or half of that where changes do not fall yet, and the pressure with it.
void widen_peak_error(const NestedOutcome& nested, RollingSolution& solution) {
  const ContactModel& model = nested.finest.problem->model;
  if (model.dimension == 3 || model.friction_coefficient == 0 || !model.approach) return;
  constexpr double to_come = 2;
  solution.peak_pressure_error += to_come * nested.last_change_of_load() * solution.peak_pressure;
}

RollingSolution answer_from(const NestedOutcome& nested, const ContactModel& model) {
  RollingSolution solution;
  if (nested.status == Status::converged) {
    const ContactLevel& level = nested.finest;
    const auto summed = [&](const InfluenceOperator& influence) {
      return summarise(*level.problem, influence, level.outcome.unknowns, level.outcome.zone, level.edge);
    };
    GridSolution answer = level.problem->friction
                              ? summed(*level.influence)
                              : summed(InfluenceOperator(model, *level.table, level.problem->grid, true));
    solution = std::move(answer.solution);
    take_slow_rolling(model, level.error, answer.powers, solution);
    take_limits(nested, solution);
    widen_peak_error(nested, solution);
    set_error(nested.error_estimate(level.error, solution.rolling_resistance), solution);
    if (model.asked_tolerance && !(solution.rolling_resistance_error <= *model.tolerance * answer.powers.scale())) {
      solution.warnings.push_back(
          tolerance_missed(*model.tolerance, solution, message_text(solution.contact_nodes, " nodes"), nested.reason));
    }
  }
  solution.status = nested.status;
  if (nested.status != Status::converged) solution.reason = nested.reason;
  solution.friction_needed = nested.friction_needed;
  solution.friction_borne = nested.friction_borne;
  solution.iterations = nested.finest.outcome.iterations;
  return solution;
}

}  // namespace

RollingSolution solve_on_coarse_grid(const ContactModel& model) {
  constexpr double few_cells_of_line = 12;
  return answer_from(
      solve_nested(model, model.dimension == 3 ? tied_grids(model, tied_cells(step_for(model, coarsest_step)))
                                               : tied_lines(model, few_cells_of_line)),
      model);
}

int most_nodes(const ContactModel& model) { return model.dimension == 3 ? 250000 : 20000; }

RollingSolution solve_on_grids(const ContactModel& model, int most_nodes) {
  RollingSolution solution = answer_from(solve_nested_to_tolerance(model, most_nodes), model);
  if (solution.status == Status::converged && !(solution.law_violation <= trusted_violation) &&
      solution.contact_nodes <= factorisable_nodes) {
    ContactModel factorised = model;
    factorised.method = Method::newton_dense;
    solution = answer_from(solve_nested_to_tolerance(factorised, std::min(most_nodes, factorisable_nodes)), factorised);
  }
  solution.method = model.method == Method::newton_dense ? model.method : Method::newton;
  return solution;
}

}  // namespace rollres
