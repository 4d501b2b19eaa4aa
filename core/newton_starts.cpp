#include "core/newton_starts.hpp"

#include <algorithm>
#include <cmath>

namespace rollres {

namespace {

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

}  // namespace

NewtonOutcome solve_cold(const ContactProblem& problem, const ContactLevel& level, const ContactUnknowns& guess,
                         const NewtonOptions& options) {
  if (!problem.friction) return newton_contact(problem, *level.table, *level.influence, guess, options);
  const ContactUnknowns start =
      frictionless_start(problem, level, guess, problem.scene.rotation_ratio.value_or(1.0), options);
  NewtonOptions sticking = options;
  sticking.first_all_stick = !problem.rotation_given();
  return newton_contact(problem, *level.table, *level.influence, start, sticking);
}

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

}  // namespace rollres
