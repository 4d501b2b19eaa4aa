#include "core/newton/newton_starts.hpp"

#include <algorithm>
#include <cmath>

#include "core/newton/contact_powers.hpp"
#include "core/newton/rotation_path.hpp"

namespace rollres {

namespace {

/// Frictionless tractions as a start for friction, the rotation ratio as given.
ContactUnknowns frictionless_start(const ContactProblem& problem, const ContactLevel& level,
                                   const ContactUnknowns& guess, double rotation_ratio, const NewtonOptions& options) {
  ContactModel frictionless = problem.model;
  frictionless.friction_coefficient = 0;
  const ContactProblem normal(frictionless, problem.grid);
  ContactUnknowns start = newton_contact(normal, *level.table, *level.influence, guess, options).unknowns;
  start.shear_x = Vector::Zero(problem.grid.size());
  if (problem.lateral) start.shear_y = start.shear_x;
  start.rotation_ratio = rotation_ratio;
  return start;
}

}  // namespace

NewtonOutcome solve_cold(const ContactProblem& problem, const ContactLevel& level, const ContactUnknowns& guess,
                         const NewtonOptions& options) {
  if (!problem.friction) return newton_contact(problem, *level.table, *level.influence, guess, options);
  const ContactUnknowns start = frictionless_start(
      problem, level, guess, problem.shape.law_ratio(problem.model.rotation_ratio.value_or(1.0)), options);
  NewtonOptions sticking = options;
  sticking.first_all_stick = !problem.rotation_given();
  return newton_contact(problem, *level.table, *level.influence, start, sticking);
}

namespace {

double surplus(const ContactProblem& problem, const ContactLevel& level, const NewtonOutcome& at) {
  const CoatingMoments moments =
      problem.coating_drives() ? coating_moments(problem, *level.influence, at.unknowns) : CoatingMoments{};
  return problem.drive_surplus(at.unknowns.pressure, at.unknowns.shear_x, at.unknowns.shear_y, moments);
}

/// Solution with the drive's row between two neighbours on the path, where its surplus changes sign.
std::optional<NewtonOutcome> solve_between(const ContactProblem& problem, const ContactLevel& level,
                                           const RotationPath& path, NewtonOutcome low, NewtonOutcome high,
                                           NewtonOptions options) {
  options.most_iterations = options.path_iterations;
  const auto coupled = [&](const ContactUnknowns& start) -> std::optional<NewtonOutcome> {
    NewtonOutcome outcome = newton_contact(problem, *level.table, *level.influence, start, options);
    if (!outcome.converged) return {};
    return outcome;
  };
  double low_value = surplus(problem, level, low), high_value = surplus(problem, level, high);
  ContactUnknowns between = low.unknowns;
  const double part = low_value / (low_value - high_value);
  between.add(part, high.unknowns).add(-part, low.unknowns);
  // A node that comes into contact at the far end is not in contact yet.
  for (Vector* field : {&between.pressure, &between.shear_x, &between.shear_y})
    for (Eigen::Index i = 0; i < field->size(); ++i)
      if (low.unknowns.pressure(i) == 0) (*field)(i) = 0;
  if (std::optional<NewtonOutcome> found = coupled(between)) return found;
  bool bisect = false;
  for (int step = 0; step < 60; ++step, bisect = !bisect) {
    const double share = bisect ? 0.5 : std::clamp(low_value / (low_value - high_value), 0.05, 0.95);
    const double from = low.unknowns.rotation_ratio, to = high.unknowns.rotation_ratio;
    const double ratio = from + share * (to - from);
    if (ratio == from || ratio == to) break;
    std::optional<NewtonOutcome> middle =
        path.solve_at(ratio, std::abs(low_value) < std::abs(high_value) ? low.unknowns : high.unknowns);
    if (!middle) return {};
    if (std::optional<NewtonOutcome> found = coupled(middle->unknowns)) return found;
    const double value = surplus(problem, level, *middle);
    ((value < 0) == (low_value < 0) ? low : high) = std::move(*middle);
    ((value < 0) == (low_value < 0) ? low_value : high_value) = value;
  }
  return {};
}

/// Where following the path ended.
struct PathResult {
  std::optional<NewtonOutcome> found;
  bool at_end = false;  // everything slides the way that the drive asks for, which is not met
};

/// Highest point of the drive's surplus (times `direction`) between two points on the path, or any where it is
/// positive, the middle one of three being higher than its neighbours.
NewtonOutcome maximise_surplus(const ContactProblem& problem, const ContactLevel& level, const RotationPath& path,
                               int direction, double low, double high, NewtonOutcome middle) {
  const auto height = [&](const NewtonOutcome& at) { return direction * surplus(problem, level, at); };
  for (int step = 0; step < 16 && height(middle) < 0; ++step) {
    const double at = middle.unknowns.rotation_ratio;
    constexpr double part = 0.381966;
    const bool upper = std::abs(high - at) > std::abs(at - low);
    const double ratio = at + part * ((upper ? high : low) - at);
    std::optional<NewtonOutcome> found = path.solve_at(ratio, middle.unknowns);
    if (!found) break;
    if (height(*found) > height(middle)) {
      (upper ? low : high) = at;
      middle = std::move(*found);
    } else {
      (upper ? high : low) = ratio;
    }
  }
  return middle;
}

/// Follows the path one way, until omega takes the value given or the drive's row is met.
PathResult follow_path(const ContactProblem& problem, const ContactLevel& level, RotationPath& path,
                       const NewtonOptions& options) {
  if (problem.rotation_given()) {
    const double wanted = problem.shape.law_ratio(*problem.model.rotation_ratio);
    for (int point = 0; point < options.most_points; ++point) {
      if (path.ratio() == wanted) return {path.here()};
      if (std::abs(path.ratio()) > options.end_of_path || !path.advance(wanted)) break;
    }
    return {};
  }
  const int sign = surplus(problem, level, path.here()) < 0 ? -1 : 1;
  NewtonOutcome before = path.here(), last = before;
  for (int point = 0; point < options.most_points; ++point) {
    before = std::move(last);
    last = path.here();
    if (std::abs(path.ratio()) >= options.end_of_path) return {{}, path.direction() == -sign};
    if (!path.advance(path.direction() * options.end_of_path)) return {};
    const double value = sign * surplus(problem, level, path.here()), last_value = sign * surplus(problem, level, last);
    if (value <= 0) return {solve_between(problem, level, path, last, path.here(), options)};
    if (path.pivoting() || !(last_value < value && last_value < sign * surplus(problem, level, before))) continue;
    const NewtonOutcome top =
        maximise_surplus(problem, level, path, -sign, before.unknowns.rotation_ratio, path.ratio(), std::move(last));
    if (sign * surplus(problem, level, top) <= 0) return {solve_between(problem, level, path, before, top, options)};
    last = top;
  }
  return {};
}

NewtonOutcome solve_on_path(const ContactProblem& problem, const ContactLevel& level, const ContactUnknowns& guess,
                            const NewtonOptions& options, bool pivoting) {
  const RotationPath path(problem, level, frictionless_start(problem, level, guess, 1, options), options);
  if (!path.started()) return {};
  const bool upwards = problem.rotation_given() ? problem.shape.law_ratio(*problem.model.rotation_ratio) > path.ratio()
                                                : surplus(problem, level, path.here()) < 0;
  NewtonOutcome failed;
  // On a part that is folded back the end looked for may lie the other way.
  for (const int direction : {upwards ? 1 : -1, upwards ? -1 : 1}) {
    RotationPath way = path;
    way.set_direction(direction, pivoting);
    PathResult result = follow_path(problem, level, way, options);
    if (result.found) {
      result.found->iterations = way.iterations();
      return *result.found;
    }
    if (way.here().reached_border) failed = way.here();
    if (result.at_end || !pivoting) break;
  }
  failed.converged = false;
  return failed;
}

}  // namespace

NewtonOutcome solve_by_rotation(const ContactProblem& problem, const ContactLevel& level, const ContactUnknowns& guess,
                                const NewtonOptions& options) {
  return solve_on_path(problem, level, guess, options, false);
}

NewtonOutcome solve_by_pivots(const ContactProblem& problem, const ContactLevel& level, const ContactUnknowns& guess,
                              const NewtonOptions& options) {
  return solve_on_path(problem, level, guess, options, true);
}

NewtonOutcome solve_by_friction(const ContactProblem& problem, const ContactLevel& level, const ContactUnknowns& guess,
                                const NewtonOptions& options) {
  const double wanted = problem.model.friction_coefficient;
  const auto with_friction = [&](double friction) {
    ContactModel model = problem.model;
    model.friction_coefficient = friction;
    return std::make_unique<ContactProblem>(model, problem.grid);
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
