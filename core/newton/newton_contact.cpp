#include "core/newton/newton_contact.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

#include "core/numerics/solution_limits.hpp"

namespace rollres {

namespace {

/// Sets tractions outside the contact to zero; true if anything changed.
bool release(ContactUnknowns& x, const ContactMask& contact) {
  bool changed = false;
  for (std::size_t i = 0; i < contact.size(); ++i) {
    if (contact[i]) continue;
    const auto node = static_cast<Eigen::Index>(i);
    for (Vector* field : {&x.pressure, &x.shear_x, &x.shear_y})
      if (field->size() > 0 && (*field)(node) != 0) {
        (*field)(node) = 0;
        changed = true;
      }
  }
  return changed;
}

/// Tolerance of the linear solution: what the step can gain, as the maps converge quadratically, and no more than the
/// last step needs (N9).
double forcing(double residual, const NewtonOptions& options) {
  const double last = 0.05 * options.tolerance / residual;
  return std::clamp(std::max(residual, last), 1e-5, 2e-2);
}

bool touches_border(const ContactProblem& problem, const ContactMask& contact) {
  const SurfaceGrid& grid = problem.grid;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      if (contact[static_cast<std::size_t>(grid.index(column, row))] &&
          (column == 0 || column == grid.columns - 1 || (problem.sphere && row == grid.rows - 1)))
        return true;
  return false;
}

}  // namespace

NewtonOutcome newton_contact(const ContactProblem& problem, const InfluenceTable& table,
                             const InfluenceOperator& influence, const ContactUnknowns& start,
                             const NewtonOptions& options) {
  NewtonOutcome outcome;
  ContactUnknowns x = start;
  ContactMask contact = loaded_nodes(x);
  NaturalMaps maps = natural_maps(problem, influence, x, contact);
  ContactUnknowns best = x;
  double best_norm = std::numeric_limits<double>::infinity();
  std::deque<double> recent;
  constexpr std::size_t memory = 4;  // of the non-monotone acceptance
  bool first = true;

  for (; outcome.iterations < options.most_iterations; ++outcome.iterations) {
    if (!first && maps.largest <= options.tolerance) break;
    require_time();
    // On the first step the contact of the start is held: its gaps may mean nothing yet.
    const ContactMask chosen = first ? contact : choose_contact(problem, influence, x, maps, contact);
    ContactUnknowns base = x;
    NaturalMaps base_maps = maps;
    if (release(base, chosen)) base_maps = natural_maps(problem, influence, base, chosen);
    const ActiveLaws laws = choose_laws(problem, influence, base, base_maps, chosen, first && options.first_all_stick);
    if (laws.contact.empty()) break;

    const NewtonSystem system(problem, influence, laws);
    const LawResiduals right = law_residuals(problem, influence, base, base_maps, laws);
    const int unknowns = static_cast<int>(laws.contact.size()) * (problem.friction ? (problem.sphere ? 3 : 2) : 1);
    const bool dense = options.dense || unknowns <= options.dense_unknowns;
    LinearStep linear =
        dense ? system.solve_dense(table, right) : system.solve_krylov(right, forcing(maps.largest, options), 300);
    outcome.krylov_iterations += linear.iterations;
    if (!linear.solved && !dense && unknowns <= options.factorisable_unknowns)
      linear = system.solve_dense(table, right);
    if (!linear.solved) break;

    // Full step from the released state, shortened while the maps grow beyond what they were lately.
    ContactUnknowns step = linear.step;
    recent.push_back(maps.mean_square);
    if (recent.size() > memory) recent.pop_front();
    const double allowed =
        first ? std::numeric_limits<double>::infinity() : *std::max_element(recent.begin(), recent.end());
    ContactUnknowns candidate, kept;
    NaturalMaps candidate_maps, kept_maps;
    double kept_square = std::numeric_limits<double>::infinity();
    for (double factor = 1; factor > 0.05; factor *= 0.5) {
      candidate = base;
      candidate.add(factor, step);
      candidate_maps = natural_maps(problem, influence, candidate, chosen);
      if (!(candidate_maps.mean_square >= kept_square)) {
        kept = candidate;
        kept_maps = candidate_maps;
        kept_square = candidate_maps.mean_square;
      }
      if (candidate_maps.mean_square <= allowed) break;
    }
    if (!std::isfinite(kept_square)) break;
    x = std::move(kept);
    maps = std::move(kept_maps);
    contact = chosen;
    first = false;
    if (maps.largest < best_norm) {
      best_norm = maps.largest;
      best = x;
    }
  }
  outcome.converged = !first && maps.largest <= options.tolerance;
  if (!outcome.converged && std::isfinite(best_norm)) {
    x = best;
    maps = natural_maps(problem, influence, x, contact);
  }
  outcome.residual = maps.largest;
  contact = choose_contact(problem, influence, x, maps, contact);
  if (problem.scene.adhesion_threshold == 0)
    for (std::size_t i = 0; i < contact.size(); ++i) contact[i] = x.pressure(static_cast<Eigen::Index>(i)) > 0;
  outcome.reached_border = touches_border(problem, contact);
  const ActiveLaws laws = choose_laws(problem, influence, x, maps, contact, false);
  outcome.zone.assign(contact.size(), Zone::free);
  for (std::size_t i = 0; i < laws.contact.size(); ++i)
    outcome.zone[static_cast<std::size_t>(laws.contact[i])] = laws.zone[i];
  release(x, contact);
  outcome.unknowns = std::move(x);
  outcome.gap = std::move(maps.gap);
  return outcome;
}

}  // namespace rollres
