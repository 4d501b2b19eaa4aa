#include "core/newton/newton_contact.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <optional>

#include "core/newton/contact_powers.hpp"
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

bool touches_border(const ContactProblem& problem, const ContactMask& contact) {
  const SurfaceGrid& grid = problem.grid;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      if (contact[static_cast<std::size_t>(grid.index(column, row))] &&
          (column == 0 || column == grid.columns - 1 ||
           (problem.plane && (row == grid.rows - 1 || (!grid.folded && row == 0)))))
        return true;
  return false;
}

constexpr double unbounded = std::numeric_limits<double>::infinity();

class NewtonIteration {
 public:
  NewtonIteration(const ContactProblem& problem, const InfluenceTable& table, const InfluenceOperator& influence,
                  const ContactUnknowns& start, const NewtonOptions& options, ContactProblem* edged)
      : problem_(problem),
        edged_(edged),
        table_(table),
        influence_(influence),
        options_(options),
        x_(start),
        contact_(loaded_nodes(start)),
        maps_(natural_maps(problem, influence, start, contact_)) {}

  NewtonOutcome run() {
    while (outcome_.iterations < options_.most_iterations && !converged() && !rounded() && !idle() && step())
      ++outcome_.iterations;
    return finish();
  }

 private:
  bool converged() const { return !first_ && maps_.largest <= options_.tolerance; }

  /// Whether rounding keeps the maps from the tolerance: with little friction slips are large against mu p.
  bool rounded() const { return best_residual_ <= options_.rounded && stays_ >= options_.most_stays; }

  /// Whether sets change in circles along an edge: even cells answer sooner than patience.
  bool idle() const { return edged_ && stays_ >= options_.most_idle_steps; }

  /// One step; false if there is none.
  bool step() {
    require_time();
    // On the first step the contact of the start is held: its gaps may mean nothing yet.
    ContactMask chosen = first_ ? contact_ : choose_contact(problem_, influence_, x_, maps_, contact_);
    ContactUnknowns base = x_;
    std::optional<NaturalMaps> released;
    const bool following = edge_follows() && chosen != contact_;
    if (following) follow_edge(chosen);
    if (release(base, chosen) || following) released = natural_maps(problem_, influence_, base, chosen);
    const NaturalMaps& base_maps = released ? *released : maps_;
    ActiveLaws laws = choose_laws(problem_, influence_, base, base_maps, chosen, first_ && options_.first_all_stick);
    if (laws.contact.empty()) return false;
    laws.coating = coating_in_drive_row(problem_, influence_, base);
    const std::optional<ContactUnknowns> increment = linear_step(base, base_maps, laws);
    if (!increment || !accept_part(base, *increment, chosen)) return false;
    contact_ = std::move(chosen);
    first_ = false;
    if (edge_follows() && maps_.largest < options_.edge_follows) {
      follow_edge(contact_);
      maps_ = natural_maps(problem_, influence_, x_, contact_);
      // Where nodes join and leave as it moves, it is left where it is: it hardly moves R_r any more.
      edge_rests_ = maps_.largest < options_.edge_rests || stays_ >= options_.idle_steps;
    }
    ++stays_;
    if (maps_.largest < 0.5 * best_residual_) stays_ = 0;
    if (maps_.largest < best_residual_) {
      best_residual_ = maps_.largest;
      best_ = x_;
    }
    return true;
  }

  /// Whether the edge still follows the pressure. It hardly depends on the shear, and needs no derivative.
  bool edge_follows() const { return edged_ && !edge_rests_ && problem_.edge.curve().known(); }

  /// The cells at the edge are those of the contact; once that is known, its curve is that of the pressure.
  void follow_edge(const ContactMask& contact) {
    const bool settled = maps_.largest < options_.edge_follows;
    edged_->take_edge(settled ? edge_curve(problem_.grid, x_.pressure) : problem_.edge.curve(), contact);
  }

  /// Solution of the linearised laws (N8), by factors or by GMRES.
  std::optional<ContactUnknowns> linear_step(const ContactUnknowns& base, const NaturalMaps& maps,
                                             const ActiveLaws& laws) {
    const NewtonSystem system(problem_, influence_, laws);
    const LawResiduals right = law_residuals(problem_, influence_, base, maps, laws);
    const int unknowns = static_cast<int>(laws.contact.size()) * problem_.components();
    const bool dense = options_.dense || unknowns <= options_.dense_unknowns;
    LinearStep linear =
        dense ? system.solve_dense(table_, right) : system.solve_krylov(right, forcing(), options_.most_krylov_vectors);
    outcome_.krylov_iterations += linear.iterations;
    if (!linear.solved && !dense && unknowns <= options_.factorisable_unknowns)
      linear = system.solve_dense(table_, right);
    if (!linear.solved) return {};
    return std::move(linear.step);
  }

  /// Tolerance of the linear solution: what the step can gain, as the maps converge quadratically, and no more than the
  /// last step needs (N9).
  double forcing() const {
    const double last = 0.05 * options_.tolerance / maps_.largest;
    const double least = edge_follows() ? options_.edge_follows : options_.least_forcing;
    return std::clamp(std::max(maps_.largest, last), least, options_.most_forcing);
  }

  /// The full step, shortened while the maps grow beyond what they were lately; the best of those tried is taken.
  bool accept_part(const ContactUnknowns& base, const ContactUnknowns& increment, const ContactMask& chosen) {
    recent_.push_back(maps_.mean_square);
    if (recent_.size() > options_.remembered_steps) recent_.pop_front();
    const bool careful = stays_ >= options_.idle_steps;
    const double allowed = first_    ? unbounded
                           : careful ? recent_.back()
                                     : *std::max_element(recent_.begin(), recent_.end());
    ContactUnknowns kept;
    NaturalMaps kept_maps;
    double least = unbounded;
    for (double factor = 1; factor > options_.shortest_step; factor *= 0.5) {
      ContactUnknowns candidate = base;
      candidate.add(factor, increment);
      NaturalMaps maps = natural_maps(problem_, influence_, candidate, chosen);
      const double square = maps.mean_square;
      if (!(square >= least)) {
        kept = std::move(candidate);
        kept_maps = std::move(maps);
        least = square;
      }
      if (square <= allowed) break;
    }
    if (!std::isfinite(least)) return false;
    x_ = std::move(kept);
    maps_ = std::move(kept_maps);
    return true;
  }

  /// The last state, or the best one if that has not converged, with the zones that its maps choose.
  NewtonOutcome finish() {
    outcome_.converged = converged() || best_residual_ <= options_.rounded;
    if (!converged() && std::isfinite(best_residual_)) {
      x_ = std::move(best_);
      maps_ = natural_maps(problem_, influence_, x_, contact_);
    }
    outcome_.residual = maps_.largest;
    contact_ = choose_contact(problem_, influence_, x_, maps_, contact_);
    if (problem_.model.adhesion_threshold == 0)
      for (std::size_t i = 0; i < contact_.size(); ++i) contact_[i] = x_.pressure(static_cast<Eigen::Index>(i)) > 0;
    outcome_.reached_border = touches_border(problem_, contact_);
    const ActiveLaws laws = choose_laws(problem_, influence_, x_, maps_, contact_);
    outcome_.zone.assign(contact_.size(), Zone::free);
    for (std::size_t i = 0; i < laws.contact.size(); ++i)
      outcome_.zone[static_cast<std::size_t>(laws.contact[i])] = laws.zone[i];
    release(x_, contact_);
    outcome_.unknowns = std::move(x_);
    outcome_.gap = std::move(maps_.gap);
    outcome_.moved = std::move(maps_.moved);
    return std::move(outcome_);
  }

  const ContactProblem& problem_;
  ContactProblem* edged_;  // the same, if its edge follows the pressure
  const InfluenceTable& table_;
  const InfluenceOperator& influence_;
  const NewtonOptions& options_;
  ContactUnknowns x_, best_;
  ContactMask contact_;
  NaturalMaps maps_;
  NewtonOutcome outcome_;
  double best_residual_ = unbounded;
  int stays_ = 0;              // steps since it was halved
  std::deque<double> recent_;  // mean squares of the maps
  bool first_ = true;
  bool edge_rests_ = false;  // from then on all residuals are those of one edge
};

}  // namespace

NewtonOutcome newton_contact(const ContactProblem& problem, const InfluenceTable& table,
                             const InfluenceOperator& influence, const ContactUnknowns& start,
                             const NewtonOptions& options) {
  return NewtonIteration(problem, table, influence, start, options, nullptr).run();
}

NewtonOutcome newton_along_edge(ContactProblem& problem, const InfluenceTable& table,
                                const InfluenceOperator& influence, const ContactUnknowns& start,
                                const NewtonOptions& options) {
  return NewtonIteration(problem, table, influence, start, options, &problem).run();
}

}  // namespace rollres
