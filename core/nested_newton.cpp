#include "core/nested_newton.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/grid_choice.hpp"

namespace rollres {

namespace {

constexpr double coarsest_cells_per_half_width = 4;

ContactLevel make_level(const RollingScene& scene, const SurfaceGrid& grid) {
  ContactLevel level;
  const bool sphere = scene.indenter == Indenter::sphere;
  level.problem = std::make_unique<ContactProblem>(scene, grid);
  level.table = std::make_unique<InfluenceTable>(influence_table(scene, mirrored(grid, sphere)));
  level.influence = std::make_unique<InfluenceOperator>(scene, *level.table, grid, level.problem->friction);
  return level;
}

/// Pressure like an elliptical dome over the estimated contact.
ContactUnknowns first_guess(const ContactProblem& problem, const ContactEstimate& estimate) {
  ContactUnknowns guess;
  const SurfaceGrid& grid = problem.grid;
  guess.pressure = Vector::Zero(grid.size());
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const double y = problem.sphere ? grid.y(row) : 0, r = std::hypot(grid.x(column), y) / estimate.half_width;
      if (r < 1) guess.pressure(grid.index(column, row)) = std::sqrt(1 - r * r);
    }
  const Vector none = Vector::Zero(grid.size());
  const double load = problem.load(guess.pressure, none);
  if (load > 0) guess.pressure *= estimate.load / load;
  guess.approach = problem.scene.approach.value_or(std::isfinite(estimate.approach) ? estimate.approach : 0);
  return guess;
}

/// Frictionless tractions as a start for friction, the rotation ratio as given.
ContactUnknowns frictionless_start(const ContactProblem& problem, const ContactLevel& level,
                                   const ContactUnknowns& guess, double rotation_ratio, const NewtonOptions& options) {
  RollingScene frictionless = problem.scene;
  frictionless.friction_coefficient = 0;
  const ContactProblem normal(frictionless, problem.grid);
  ContactUnknowns start = newton_contact(normal, *level.table, *level.influence, guess, options).unknowns;
  start.shear_x = Vector::Zero(problem.grid.size());
  if (problem.sphere) start.shear_y = start.shear_x;
  start.rotation_ratio = rotation_ratio;
  return start;
}

/// Frictionless solution first, then with all contact nodes sticking: needs no start.
NewtonOutcome solve_cold(const ContactProblem& problem, const ContactLevel& level, const ContactUnknowns& guess,
                         const NewtonOptions& options) {
  if (!problem.friction) return newton_contact(problem, *level.table, *level.influence, guess, options);
  const ContactUnknowns start =
      frictionless_start(problem, level, guess, problem.scene.rotation_ratio.value_or(1.0), options);
  NewtonOptions sticking = options;
  sticking.first_all_stick = !problem.rotation_given();
  return newton_contact(problem, *level.table, *level.influence, start, sticking);
}

/// The drive's row as a function of a given rotation rises with it: brackets its root, narrows the bracket, and hands
/// over to the coupled iteration as soon as that converges. For scenes that slide almost everywhere, where the coupled
/// iteration alone wanders among sets without a sticking node.
NewtonOutcome solve_by_rotation(const ContactProblem& problem, const ContactLevel& level, const ContactUnknowns& guess,
                                const NewtonOptions& options) {
  RollingScene turning = problem.scene;
  turning.drive = Drive::rotation;
  turning.driving_torque.reset();
  turning.rotation_ratio = 1;
  const ContactProblem given_rotation(turning, problem.grid);
  const ContactUnknowns start = frictionless_start(given_rotation, level, guess, 1, options);

  struct Trial {
    double ratio, surplus;
    NewtonOutcome outcome;
  };
  int iterations = 0;
  const auto attempt = [&](double ratio, const ContactUnknowns& from) {
    ContactUnknowns first = from;
    first.rotation_ratio = ratio;
    Trial trial{ratio, RollingSolution::absent,
                newton_contact(given_rotation, *level.table, *level.influence, first, options)};
    iterations += trial.outcome.iterations;
    if (!trial.outcome.converged) {  // from the other side
      first = start;
      first.rotation_ratio = ratio;
      trial.outcome = newton_contact(given_rotation, *level.table, *level.influence, first, options);
      iterations += trial.outcome.iterations;
    }
    if (trial.outcome.converged)
      trial.surplus =
          problem.drive(trial.outcome.unknowns.pressure, trial.outcome.unknowns.shear_x) - problem.drive_target;
    return trial;
  };

  NewtonOutcome failed;
  Trial low = attempt(1, start), high = low;
  if (std::isnan(low.surplus)) return low.outcome.converged = false, low.outcome;
  // The strains under the body set the scale of the creepage.
  double width = 1e-3;
  for (; width < 1e6 && low.surplus > 0; width *= 3) low = attempt(1 - width, low.outcome.unknowns);
  for (width = 1e-3; width < 1e6 && high.surplus < 0; width *= 3) high = attempt(1 + width, high.outcome.unknowns);
  if (!(low.surplus <= 0) || !(high.surplus >= 0)) return failed;

  bool bisect = false;
  for (int step = 0; step < 80; ++step, bisect = !bisect) {
    const double share = bisect ? 0.5 : std::clamp(low.surplus / (low.surplus - high.surplus), 0.05, 0.95);
    const double ratio = low.ratio + share * (high.ratio - low.ratio);
    if (ratio == low.ratio || ratio == high.ratio) break;
    Trial middle =
        attempt(ratio, std::abs(low.surplus) < std::abs(high.surplus) ? low.outcome.unknowns : high.outcome.unknowns);
    if (std::isnan(middle.surplus)) return failed;
    const bool sticking =
        std::find(middle.outcome.zone.begin(), middle.outcome.zone.end(), Zone::stick) != middle.outcome.zone.end();
    if (sticking) {
      NewtonOutcome coupled = newton_contact(problem, *level.table, *level.influence, middle.outcome.unknowns, options);
      iterations += coupled.iterations;
      if (coupled.converged) {
        coupled.iterations = iterations;
        return coupled;
      }
    }
    (middle.surplus < 0 ? low : high) = std::move(middle);
  }
  return failed;
}

/// Solves the largest smaller friction that can be solved and follows the solution up to the friction wanted. For thin
/// layers and friction near or above one, where shear lifts or drags down much of the contact.
NewtonOutcome solve_by_friction(const ContactProblem& problem, const ContactLevel& level, const ContactUnknowns& guess,
                                const NewtonOptions& options) {
  const double wanted = problem.scene.friction_coefficient;
  const auto with_friction = [&](double friction) {
    RollingScene scene = problem.scene;
    scene.friction_coefficient = friction;
    return std::make_unique<ContactProblem>(scene, problem.grid);
  };
  NewtonOutcome outcome;
  double reached = 0;
  for (const double share : {0.9, 0.75, 0.6, 0.45, 0.3, 0.15}) {
    reached = share * wanted;
    const std::unique_ptr<ContactProblem> weaker = with_friction(reached);
    outcome = solve_cold(*weaker, level, guess, options);
    if (!outcome.converged && !weaker->rotation_given()) outcome = solve_by_rotation(*weaker, level, guess, options);
    if (outcome.converged) break;
  }
  double step = 0.1 * wanted;
  while (outcome.converged && reached < wanted && step > 1e-3 * wanted) {
    const double next = std::min(wanted, reached + step);
    NewtonOutcome further = newton_contact(next == wanted ? problem : *with_friction(next), *level.table,
                                           *level.influence, outcome.unknowns, options);
    if (further.converged) {
      outcome = std::move(further);
      reached = next;
      step *= 1.5;
    } else {
      step *= 0.5;
    }
  }
  outcome.converged = outcome.converged && reached == wanted;
  return outcome;
}

/// Bilinear values on a finer grid, zero outside the coarser one.
Vector interpolate(const Vector& values, const SurfaceGrid& from, const SurfaceGrid& to, bool sphere, double parity) {
  Vector result(to.size());
  const auto at = [&](int column, int row) {
    double sign = 1;
    if (row < 0) {
      row = -row;
      sign = parity;
    }
    if (column < 0 || column >= from.columns || row >= from.rows) return 0.0;
    return sign * values(from.index(column, row));
  };
  for (int row = 0; row < to.rows; ++row)
    for (int column = 0; column < to.columns; ++column) {
      const double x = to.x(column) / from.spacing_x - from.first_column;
      const double y = sphere ? to.y(row) / from.spacing_y : 0;
      const double left = std::floor(x), below = std::floor(y), fx = x - left, fy = y - below;
      const int c = static_cast<int>(left), r = static_cast<int>(below);
      double value = (1 - fx) * at(c, r) + fx * at(c + 1, r);
      if (fy > 0) value = (1 - fy) * value + fy * ((1 - fx) * at(c, r + 1) + fx * at(c + 1, r + 1));
      result(to.index(column, row)) = value;
    }
  return result;
}

ContactUnknowns transfer(const ContactLevel& from, const SurfaceGrid& to) {
  const SurfaceGrid& grid = from.problem->grid;
  const bool sphere = from.problem->sphere;
  ContactUnknowns start = from.outcome.unknowns;
  // Pressure inside and gap outside join at the contact's edge: their interpolated sign tells the finer contact.
  const Vector sign =
      interpolate(start.pressure - from.outcome.gap.cwiseMax(0) / from.influence->self_normal(), grid, to, sphere, 1);
  start.pressure = (sign.array() > 0).select(interpolate(start.pressure, grid, to, sphere, 1), 0.0);
  if (start.shear_x.size() > 0) start.shear_x = interpolate(start.shear_x, grid, to, sphere, 1);
  if (start.shear_y.size() > 0) start.shear_y = interpolate(start.shear_y, grid, to, sphere, -1);
  return start;
}

/// Window for a level with another spacing that leaves `margin` [m] around the contact found.
SurfaceGrid follow(const ContactLevel& level, double spacing, double margin) {
  const SurfaceGrid& grid = level.problem->grid;
  double leading = -INFINITY, trailing = INFINITY, half_width = 0;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      if (level.outcome.zone[static_cast<std::size_t>(grid.index(column, row))] != Zone::free) {
        leading = std::max(leading, grid.x(column));
        trailing = std::min(trailing, grid.x(column));
        if (level.problem->sphere) half_width = std::max(half_width, grid.y(row));
      }
  const double widest = widest_window(level.problem->scene);
  SurfaceGrid next = grid;
  next.spacing_x = spacing;
  if (level.problem->sphere) next.spacing_y = spacing;
  const auto cells = [&](double distance) {
    return static_cast<int>(std::ceil(std::clamp(distance, -widest, widest) / spacing - 1e-9));
  };
  next.first_column = -cells(margin - trailing);
  next.columns = cells(leading + margin) - next.first_column + 1;
  if (level.problem->sphere) next.rows = cells(half_width + margin) + 1;
  return next;
}

double resistance(const ContactLevel& level) {
  const ContactProblem& problem = *level.problem;
  const ContactUnknowns& x = level.outcome.unknowns;
  if (!problem.friction) {
    const Vector none = Vector::Zero(x.pressure.size());
    return problem.sphere ? problem.torque(x.pressure, none) / problem.scene.radius
                          : problem.driving_force(x.pressure, none);
  }
  return problem.driving_force(x.pressure, x.shear_x) +
         problem.torque(x.pressure, x.shear_x) * x.rotation_ratio / problem.scene.radius;
}

NewtonOptions options_for(const RollingScene& scene) {
  NewtonOptions options;
  options.dense = scene.method == Method::newton_dense;
  if (scene.indenter == Indenter::cylinder) options.dense_unknowns = 300;
  return options;
}

/// Solves on a window that grows until the contact keeps clear of its border.
/// @param coarser tried first if not null   @param last_resort whether to follow the solution from a smaller friction
ContactLevel solve_level(const RollingScene& scene, SurfaceGrid grid, const ContactLevel* coarser, bool last_resort) {
  const NewtonOptions options = options_for(scene);
  const ContactEstimate estimate = estimate_contact(scene);
  ContactLevel level;
  for (int growth = 0; growth < 12; ++growth) {
    level = make_level(scene, grid);
    const ContactProblem& problem = *level.problem;
    if (coarser)
      level.outcome = newton_contact(problem, *level.table, *level.influence, transfer(*coarser, grid), options);
    // Safer and slower, one after the other.
    const ContactUnknowns guess = first_guess(problem, estimate);
    const auto attempt = [&](const auto& method) {
      if (level.outcome.converged || level.outcome.reached_border) return;
      if (NewtonOutcome outcome = method(problem, level, guess, options); outcome.converged || outcome.reached_border)
        level.outcome = std::move(outcome);
      else if (level.outcome.zone.empty())
        level.outcome = std::move(outcome);
    };
    attempt(solve_cold);
    if (problem.friction && !problem.rotation_given()) attempt(solve_by_rotation);
    if (problem.friction && last_resort) attempt(solve_by_friction);
    if (!level.outcome.reached_border) break;
    const double reach = -grid.x(0);
    if (reach >= widest_window(scene) && grid.x(grid.columns - 1) >= widest_window(scene)) break;
    grid = follow(level, grid.spacing_x, std::max(4 * grid.spacing_x, 0.4 * reach));
  }
  return level;
}

std::string describe_failure(const ContactLevel& level) {
  std::ostringstream text;
  if (level.outcome.reached_border) {
    text << "the contact spreads to the edge of the body (more than 0.98 R): the load or the approach is too large "
            "for this body";
    return text.str();
  }
  text << "stopped after " << level.outcome.iterations << " Newton iterations at spacing "
       << level.problem->grid.spacing_x << " m with the laws of contact violated by " << level.outcome.residual
       << " of the largest pressure";
  return text.str();
}

/// Surplus of the drive's row when the whole contact slides, the body turning too fast (+1) or too slow (-1).
double sliding_surplus(RollingScene scene, const SurfaceGrid& grid, int direction) {
  const ContactProblem wanted(scene, grid);
  scene.drive = Drive::rotation;
  scene.driving_torque.reset();
  scene.rotation_ratio = 1 + direction * 1e4;
  const ContactLevel level = solve_level(scene, grid, nullptr, false);
  if (!level.outcome.converged || level.problem->grid.size() == 0) return RollingSolution::absent;
  const ContactProblem on_grid(
      [&] {
        RollingScene original = wanted.scene;
        return original;
      }(),
      level.problem->grid);
  return on_grid.drive(level.outcome.unknowns.pressure, level.outcome.unknowns.shear_x) - on_grid.drive_target;
}

}  // namespace

double friction_needed(const RollingScene& scene, const SurfaceGrid& half_grid) {
  // Which way friction falls short, then the coefficient at which the surplus vanishes: nearly linear in it.
  const auto surplus = [&](double friction, int direction) {
    RollingScene trial = scene;
    trial.friction_coefficient = friction;
    return direction * sliding_surplus(trial, half_grid, direction);
  };
  const double given = scene.friction_coefficient;
  const double forward = surplus(given, 1), backward = surplus(given, -1);
  if (forward >= 0 && backward >= 0) return given;
  const int direction = forward < 0 ? 1 : -1;
  double low = given, low_value = direction > 0 ? forward : backward, high = given, high_value = low_value;
  for (int doubling = 0; doubling < 40 && high_value < 0; ++doubling) {
    low = high;
    low_value = high_value;
    high = 2 * high;
    high_value = surplus(high, direction);
    if (!std::isfinite(high_value)) return INFINITY;
  }
  if (!(high_value >= 0)) return INFINITY;
  for (int step = 0; step < 60 && high - low > 1e-6 * high; ++step) {
    // Regula falsi kept off the ends.
    double middle = low + (high - low) * std::clamp(-low_value / (high_value - low_value), 0.02, 0.98);
    const double value = surplus(middle, direction);
    if (!std::isfinite(value)) return INFINITY;
    if (value < 0) {
      low = middle;
      low_value = value;
    } else {
      high = middle;
      high_value = value;
    }
  }
  return high;
}

NestedOutcome solve_nested(const RollingScene& scene, double spacing,
                           const std::function<bool(const NestedOutcome&)>& finer) {
  NestedOutcome nested;
  const ContactEstimate estimate = estimate_contact(scene);
  const double half_width = std::min(estimate.half_width, 0.7 * scene.radius);
  int coarsenings = 0;
  while (half_width / (spacing * std::ldexp(1.0, coarsenings + 1)) >= coarsest_cells_per_half_width) ++coarsenings;

  double current = spacing * std::ldexp(1.0, coarsenings);
  const auto first_window = [&] {
    return window(scene.indenter, current, std::min(1.3 * half_width + 3 * current, widest_window(scene)));
  };
  nested.finest = solve_level(scene, first_window(), nullptr, coarsenings == 0);
  for (;;) {
    const ContactLevel& level = nested.finest;
    if (level.outcome.reached_border) break;
    const bool solved = level.outcome.converged;
    if (solved) nested.finest.rolling_resistance = resistance(level);
    if (coarsenings == 0) {
      if (!solved) break;
      nested.status = Status::converged;
      if (!finer || !finer(nested)) return nested;
      ++coarsenings;
      nested.status = Status::not_converged;
    }
    --coarsenings;
    const double coarse = current;
    current *= 0.5;
    // A grid too coarse for its layer may have no solution: the next one then starts afresh.
    ContactLevel next =
        solved ? solve_level(scene, follow(level, current, 1.5 * coarse + 2 * current), &level, coarsenings == 0)
               : solve_level(scene, first_window(), nullptr, coarsenings == 0);
    nested.coarser_resistance = solved ? level.rolling_resistance : RollingSolution::absent;
    nested.finest = std::move(next);
  }
  const bool drive_may_fail = nested.finest.problem->friction && scene.drive != Drive::rotation;
  if (drive_may_fail && !nested.finest.outcome.reached_border) {
    const double needed = friction_needed(scene, nested.finest.problem->grid);
    if (needed > scene.friction_coefficient) {
      nested.status = Status::no_steady_state;
      nested.friction_needed = needed;
      std::ostringstream text;
      text << "the drive asks for more traction than friction can give: needs a friction coefficient of at least "
           << needed << ", has " << scene.friction_coefficient;
      nested.reason = text.str();
      return nested;
    }
  }
  nested.reason = describe_failure(nested.finest);
  return nested;
}

}  // namespace rollres
