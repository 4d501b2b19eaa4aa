#include "core/newton/nested_newton.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "core/edge/folded_grid.hpp"
#include "core/estimate/grid_choice.hpp"
#include "core/messages/message_text.hpp"
#include "core/model/contact_surface.hpp"
#include "core/model/indenter_shape.hpp"
#include "core/newton/contact_powers.hpp"
#include "core/newton/friction_limit.hpp"
#include "core/newton/newton_starts.hpp"
#include "core/numerics/solution_limits.hpp"

namespace rollres {

namespace {

NewtonOptions options_for(const ContactModel& model) {
  NewtonOptions options;
  options.dense = model.method == Method::newton_dense;
  if (model.dimension == 2) options.dense_unknowns = 300;
  return options;
}

std::string describe_failure(const ContactLevel& level) {
  std::ostringstream text;
  if (level.outcome.reached_border) {
    const ContactModel& model = level.problem->model;
    constexpr double well_inside = 0.3;  // of the radius: no estimate is off by so much
    if (const double expected = estimate_contact(model).half_width; expected < well_inside * model.radius)
      text << "the nodes in contact did not settle and spread to the edge of the body, though the contact should reach "
              "about "
           << expected << " m to each side; another spacing"
           << (model.approach ? ", or a load in place of the approach," : "") << " may answer";
    else
      text << "the contact spreads to the edge of the body (more than 0.98 R): the load or the approach is too large "
              "for this body";
    return text.str();
  }
  text << "stopped after " << level.outcome.iterations << " Newton iterations at spacing "
       << level.problem->grid.spacing_x << " m with the laws of contact violated by " << level.outcome.residual
       << " of the largest pressure; another spacing may answer";
  if (const ContactModel& model = level.problem->model; model.inertia) text << ", or \"inertia\": \"off\"";
  return text.str();
}

void refuse(NestedOutcome& nested, const ContactModel& model, double needed) {
  nested.status = Status::no_steady_state;
  if (std::isinf(needed)) {
    nested.reason = message_text(
        "the drive asks for more traction than friction can give with traction_limit = ", *model.traction_limit, " Pa");
    return;
  }
  nested.reason = too_much_traction(needed, model.friction_coefficient);
  nested.friction_needed = needed;
}

void refuse_digging(NestedOutcome& nested, const ContactModel& model, double borne) {
  std::ostringstream text;
  text << "friction makes the body dig itself in until the contact spreads to the edge of the body (more than 0.98 R): "
          "bears a friction coefficient of at most "
       << borne << ", has " << model.friction_coefficient;
  nested.status = Status::no_steady_state;
  nested.reason = text.str();
  nested.friction_borne = borne;
}

/// What is asked of a level that is solved.
void measure(ContactLevel& level) {
  const NewtonOutcome& outcome = level.outcome;
  level.powers = contact_powers(*level.problem, outcome.moved, moved_coating(*level.influence, outcome.unknowns),
                                outcome.unknowns, outcome.zone);
  level.error = grid_error(*level.problem, outcome.unknowns.pressure, outcome.zone, level.powers);
  level.error.steps = level.table->steps;
}

/// None with the paper's kinematics, whose grid is the paper's, with adhesion, or where the load is not given.
EdgeCorrection correction_of(const ContactLevel& level) {
  const ContactProblem& problem = *level.problem;
  const ContactModel& model = problem.model;
  if (!problem.plane || model.kinematics != Kinematics::consistent || model.adhesion_threshold > 0 || !model.load)
    return {};
  // Whose contact is turned, or no ellipse.
  if (model.outline && (!model.mirrored() || model.profiled())) return {};
  const ContactUnknowns& x = level.outcome.unknowns;
  const double turning = problem.turning_ratio(x.rotation_ratio) / problem.shape.radius();
  PressedSphere sphere{model, problem.grid, *level.influence, problem.profile, problem.load.of_pressure, {}};
  sphere.of_resistance = problem.resisting.of_pressure + turning * problem.torque.of_pressure;
  if (level.influence->coating()) {
    const double part = problem.shape.of_coating() * (problem.turning_ratio(x.rotation_ratio) - 1);
    sphere.of_resistance += moments_row(problem, *level.influence, x, {part, 0}).of_pressure;
  }
  if (problem.friction) {
    const SurfaceGrid& grid = problem.grid;
    const Vector none = Vector::Zero(grid.size());
    const Displacements by_shear = level.influence->apply(none, x.shear_x, x.shear_y);
    for (Eigen::Index row = 0; row < grid.rows; ++row)
      sphere.height.segment(row * grid.columns, grid.columns) -=
          by_shear.w.segment(row * (grid.columns + 1), grid.columns);
    sphere.resistance_of_shear = problem.resistance(none, x.shear_x, x.shear_y, x.rotation_ratio, {});
  }
  if (level.influence->coating())  // of which M is no linear functional
    sphere.resistance_of_shear = level.powers.resultants - sphere.of_resistance.dot(x.pressure);
  if (problem.grid.folded) return edge_correction(sphere, x.pressure, x.approach);
  // By what is even in y of the height and the pressure: the rest is small of first order, and acts by its square.
  const SurfaceGrid half = folded(problem.grid);
  const auto sum_of_sides = [&](const Vector& values) -> Vector {
    return side_of(problem.grid, values, 1) + side_of(problem.grid, values, -1);
  };
  const auto without_twice = [&](Vector values) {  // what the sum has twice on the axis
    values.head(half.columns) *= 0.5;
    return values;
  };
  const InfluenceOperator even(model, *level.table, half, false);
  const PressedSphere mean{model,
                           half,
                           even,
                           0.5 * sum_of_sides(sphere.height),
                           without_twice(sum_of_sides(sphere.of_load)),
                           without_twice(sum_of_sides(sphere.of_resistance)),
                           sphere.resistance_of_shear};
  return edge_correction(mean, 0.5 * sum_of_sides(x.pressure), x.approach);
}

/// A solution of even cells becomes one with the edge that its pressure tells, if there is one.
void find_edge(ContactLevel& level, const NewtonOptions& options) {
  ContactProblem& problem = *level.problem;
  const ContactUnknowns& start = level.outcome.unknowns;
  problem.take_edge(edge_curve(problem.grid, start.pressure), loaded_nodes(start));
  if (!problem.edge.curve().known()) return;
  NewtonOutcome found = newton_along_edge(problem, *level.table, *level.influence, start, options);
  if (found.converged && !found.reached_border)
    level.outcome = std::move(found);
  else
    problem.edge = {};
}

/// The smallest grid that holds two of the same spacing: a window may grow, but never moves away from what it held.
SurfaceGrid cover(const SurfaceGrid& a, const SurfaceGrid& b) {
  SurfaceGrid both = a;
  both.first_column = std::min(a.first_column, b.first_column);
  both.columns = std::max(a.first_column + a.columns, b.first_column + b.columns) - both.first_column;
  both.first_row = std::min(a.first_row, b.first_row);
  both.rows = std::max(a.first_row + a.rows, b.first_row + b.rows) - both.first_row;
  return both;
}

}  // namespace

ContactLevel solve_level(const ContactModel& model, SurfaceGrid grid, const ContactLevel* coarser, Effort effort) {
  NewtonOptions options = options_for(model);
  if (effort == Effort::refinement) options.most_iterations = options.refining_iterations;
  if (effort == Effort::start) options.tolerance = std::max(options.tolerance, options.start_tolerance);
  const ContactEstimate estimate = estimate_contact(model);
  ContactLevel level;
  for (int growth = 0; growth < 12; ++growth) {
    level = make_level(model, grid);
    ContactProblem& problem = *level.problem;
    if (effort != Effort::start) options.tolerance = std::min(options.tolerance, residual_of_gaps(level, estimate));
    if (coarser && model.adhesion_threshold == 0) {
      const ContactUnknowns start = transfer(*coarser, grid);
      if (problem.follows_edge())
        problem.take_edge(edge_curve(coarser->problem->grid, coarser->outcome.unknowns.pressure), loaded_nodes(start));
      level.outcome = newton_along_edge(problem, *level.table, *level.influence, start, options);
      if (!level.outcome.converged) problem.edge = {};
    }
    // Safer and slower, one after the other.
    const ContactUnknowns guess = first_guess(problem, estimate);
    const double reach = -grid.x(0);
    const bool widest = reach >= widest_window(model) && grid.x(grid.columns - 1) >= widest_window(model);
    const auto attempt = [&](const auto& method) {
      if (level.outcome.converged || (level.outcome.reached_border && !widest)) return;
      NewtonOutcome outcome = method(problem, level, guess, options);
      // Of several failures the first one is kept.
      if (outcome.converged || outcome.reached_border || level.outcome.zone.empty()) level.outcome = std::move(outcome);
    };
    attempt(solve_cold);
    if (problem.friction && (effort == Effort::all || (effort == Effort::start && !problem.rotation_given())))
      attempt(solve_by_rotation);
    if (problem.friction && effort == Effort::all && !level.outcome.converged &&
        (problem.rotation_given() || sliding_limit(model, grid) != SlidingLimit::not_enough)) {
      if (problem.lateral) attempt(solve_by_friction);
      attempt(solve_by_pivots);
    }
    if (level.outcome.converged && effort != Effort::start && problem.follows_edge() && !problem.edge.curve().known())
      find_edge(level, options);
    if (!level.outcome.reached_border || widest) break;
    grid = cover(grid, follow(level, grid, std::max(4 * grid.spacing_x, 0.4 * reach)));
  }
  return level;
}

double NestedOutcome::error_estimate(const GridError& error, double resistance) const {
  const double last = last_change();
  const int dimension = finest.problem->model.dimension;
  constexpr double rounding = 1e-11;
  double to_come = tied ? expected_change_of_tied_line(last, change_before, finest.powers)
                        : expected_change(finest.problem->model.dimension, last, change_before, finest.powers,
                                          edge_trust(finest.problem->model, finest.edge.trust, error));
  // Hollows of a profile that cells pass over make changes irregular.
  if (finest.problem->model.profiled() && last > to_come) to_come = last;
  return error.estimate(resistance, limit(&GridNumbers::resistance).change_left(to_come),
                        std::hypot(open_friction(dimension, finest.powers), open_load(dimension, finest.powers))) +
         rounding * finest.powers.halves;
}

double NestedOutcome::last_change() const {
  return coarser.empty() ? RollingSolution::absent : std::abs(coarser.back().resistance - finest.powers.resistance());
}

double NestedOutcome::last_change_of_load() const {
  return coarser.empty() ? 0 : std::abs(coarser.back().load / numbers().load - 1);
}

GridNumbers NestedOutcome::numbers() const {
  const ContactUnknowns& x = finest.outcome.unknowns;
  return {finest.powers.resistance(), finest.problem->turning_ratio(x.rotation_ratio),
          finest.problem->side_force(x.pressure, x.shear_x, x.shear_y),
          finest.problem->load(x.pressure, x.shear_x, x.shear_y)};
}

HalvingLimit NestedOutcome::limit(double GridNumbers::*number) const {
  if (!tied || coarser.size() < 3) return {};
  const auto last = coarser.end();
  return HalvingLimit({last[-3].*number, last[-2].*number, last[-1].*number, numbers().*number},
                      (1 - finest.error.slow_share) * finest.powers.slip_resolved());
}

double NestedOutcome::error_estimate() const {
  ContactPowers powers = finest.powers;
  powers.take(finest.edge);
  const double estimate = error_estimate(finest.error, powers.resistance()) / powers.scale();
  const double missing = (1 - finest.error.slow_share) * powers.missing() / powers.scale();
  const bool resists = std::abs(powers.resistance()) >= negligible_resistance * powers.halves;
  return resists && missing > trusted_balance ? std::max(estimate, missing) : estimate;
}

NestedOutcome better_of(NestedOutcome answer, NestedOutcome other) {
  if (other.status != Status::converged || !(other.error_estimate() < answer.error_estimate())) return answer;
  other.reason = answer.reason;
  return other;
}

NestedOutcome solve_nested(const ContactModel& model, const GridSeries& grids,
                           const std::function<bool(const NestedOutcome&)>& finer) {
  NestedOutcome nested;
  nested.tied = grids.tied;
  int coarsening = grids.coarsest, last = 0;
  const bool drive_may_fail = model.friction_coefficient > 0 && model.drive != Drive::rotation;
  bool sliding_checked = !drive_may_fail;
  bool answered = false;
  NestedOutcome best;  // of the grids before, where a finer one does not always tell more
  const auto effort = [&] {
    if (coarsening > last || !grids.last_resort) return Effort::start;
    return answered ? Effort::refinement : Effort::all;
  };
  nested.finest = solve_level(model, grids.first(coarsening), nullptr, effort());
  for (;;) {
    const ContactLevel& level = nested.finest;
    if (level.outcome.reached_border) break;
    const bool solved = level.outcome.converged;
    if (solved) measure(nested.finest);
    if (!solved && !sliding_checked) {
      sliding_checked = true;
      // No steady state on a coarse grid: most likely none on the finest; it alone decides.
      if (sliding_limit(model, level.problem->grid) == SlidingLimit::not_enough) {
        coarsening = last;
        const double needed = friction_needed(model, grids.first(coarsening));
        if (needed > model.friction_coefficient) {
          refuse(nested, model, needed);
          return nested;
        }
        nested.finest = solve_level(model, grids.first(coarsening), nullptr, Effort::all);
        continue;
      }
    }
    if (coarsening == last) {
      if (!solved) break;
      if (const std::optional<double> end = end_in_contact(level)) {
        nested.reason = message_text("the contact reaches the end of the profile near y = ", *end,
                                     " m, an edge that presses without bound: the profile must go on to where the body "
                                     "has left the layer");
        return nested;
      }
      nested.status = Status::converged;
      answered = true;
      ContactLevel& answer = nested.finest;
      try {
        answer.edge = correction_of(answer);
      } catch (const BeyondLimits&) {  // the answer stands without it
      }
      if (!finer || !finer(nested)) return better_of(std::move(nested), std::move(best));
      --last;
    }
    --coarsening;
    // A grid too coarse for its layer may have no solution: the next one then starts afresh.
    ContactLevel next;
    try {
      next = solved ? solve_level(model, grids.around(level, coarsening), &level, effort())
                    : solve_level(model, grids.first(coarsening), nullptr, effort());
    } catch (const BeyondLimits& limit) {
      if (nested.status != Status::converged) throw;
      nested.reason = limit.what();
      return better_of(std::move(nested), std::move(best));
    }
    // A finer grid for a tolerance's sake that has no solution leaves the one that was found.
    if (nested.status == Status::converged && !next.outcome.converged)
      return better_of(std::move(nested), std::move(best));
    const double change =
        expected_change(model.dimension, solved ? nested.last_change() : RollingSolution::absent, nested.change_before);
    std::vector<GridNumbers> coarser;
    if (solved) {
      coarser = nested.coarser;
      coarser.push_back(nested.numbers());
      if (coarser.size() > 3) coarser.erase(coarser.begin());
    }
    if (answered) {
      best = better_of(std::move(nested), std::move(best));
      nested = {};
      nested.tied = grids.tied;
    }
    nested.change_before = change;
    nested.coarser = std::move(coarser);
    nested.finest = std::move(next);
  }
  if (drive_may_fail && !nested.finest.outcome.reached_border) {
    const double needed = friction_needed(model, nested.finest.problem->grid);
    if (needed > model.friction_coefficient) {
      refuse(nested, model, needed);
      return nested;
    }
  }
  if (model.friction_coefficient > 0 && nested.finest.outcome.reached_border) {
    const double borne = friction_borne(model, grids.first(coarsening));
    if (!std::isnan(borne)) {
      refuse_digging(nested, model, borne);
      return nested;
    }
  }
  nested.reason = describe_failure(nested.finest);
  return nested;
}

}  // namespace rollres
