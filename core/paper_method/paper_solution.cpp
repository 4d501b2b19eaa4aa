#include "core/paper_method/paper_solution.hpp"

#include <algorithm>
#include <cmath>

#include "core/estimate/grid_choice.hpp"
#include "core/influence/influence.hpp"
#include "core/model/stated_error.hpp"
#include "core/newton/grid_error.hpp"
#include "core/newton/grid_solution.hpp"
#include "core/paper_method/active_set.hpp"

namespace rollres {

namespace {

/// Unknowns on rows y >= 0 from those on the whole grid; `asymmetry` is the largest difference to the mirror image over
/// the largest pressure.
ContactUnknowns upper_half(const ContactState& state, const SurfaceGrid& half, double& asymmetry) {
  ContactUnknowns unknowns;
  unknowns.approach = state.approach;
  unknowns.rotation_ratio = std::isnan(state.rotation_ratio) ? 0 : state.rotation_ratio;
  const double scale = state.pressure.cwiseAbs().maxCoeff();
  const auto keep = [&](const Vector& whole, double parity) {
    if (whole.size() == 0) return whole;
    const Eigen::Index size = half.size();
    const Vector upper = whole.tail(size);
    asymmetry = std::max(asymmetry, (mirrored(half, upper, parity) - whole).cwiseAbs().maxCoeff() / scale);
    return upper;
  };
  unknowns.pressure = keep(state.pressure, 1);
  unknowns.shear_x = keep(state.shear_x, 1);
  unknowns.shear_y = keep(state.shear_y, -1);
  return unknowns;
}

/// An answer of the paper's method on one grid.
struct PaperAnswer {
  RollingSolution solution;
  ContactPowers powers;
  GridError error;
};

/// The paper's method on one grid, which grows until the contact keeps clear of its border.
PaperAnswer solve_paper(const ContactModel& model, double spacing) {
  double half_width = std::min(1.3 * estimate_contact(model).half_width + 2 * spacing, widest_window(model));
  for (;; half_width = std::min(1.4 * half_width, widest_window(model))) {
    const SurfaceGrid half = window(model.dimension, spacing, half_width);
    const InfluenceTable table = influence_table(model, mirrored(half));
    const ContactState state = solve_active_set(model, table, mirrored(half));
    if (state.reached_border && half_width < widest_window(model)) continue;
    PaperAnswer answer;
    RollingSolution& solution = answer.solution;
    if (state.status == Status::converged) {
      double asymmetry = 0;
      const ContactUnknowns unknowns = upper_half(state, half, asymmetry);
      const std::vector<Zone> zone(state.zone.end() - half.size(), state.zone.end());
      const ContactProblem problem(model, half);
      const InfluenceOperator influence(model, table, half, true);
      GridSolution summed = summarise(problem, influence, unknowns, zone);
      solution = std::move(summed.solution);
      answer.powers = summed.powers;
      solution.law_violation = std::max(solution.law_violation, asymmetry);
      answer.error = grid_error(problem, unknowns.pressure, zone, answer.powers);
      answer.error.steps = table.steps;
    }
    solution.status = state.status;
    solution.reason = state.reason;
    solution.friction_needed = state.friction_needed;
    solution.iterations = state.iterations;
    solution.method = Method::active_set;
    return answer;
  }
}

}  // namespace

RollingSolution solve_paper(const ContactModel& model) {
  const double spacing = model.spacing.value_or(default_spacing(model));
  auto [solution, powers, error] = solve_paper(model, spacing);
  if (solution.status != Status::converged) return solution;
  const RollingSolution coarser = solve_paper(model, 2 * spacing).solution;
  const double change = coarser.status == Status::converged
                            ? std::abs(coarser.rolling_resistance - solution.rolling_resistance)
                            : RollingSolution::absent;
  take_slow_rolling(model, error, powers, solution);
  const double to_come = expected_change(model.dimension, change, RollingSolution::absent, powers);
  set_error(error.estimate(solution.rolling_resistance, to_come,
                           std::hypot(open_friction(model.dimension, powers), open_load(model.dimension, powers))),
            solution);
  return solution;
}

}  // namespace rollres
