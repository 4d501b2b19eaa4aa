#include "core/newton/rotation_path.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/solution_limits.hpp"

namespace rollres {

namespace {

ContactProblem with_drive(const ContactProblem& problem, Drive drive, double ratio) {
  ContactModel model = problem.model;
  model.drive = drive;
  model.driving_torque.reset();
  model.rotation_ratio.reset();
  if (drive == Drive::rotation) model.rotation_ratio = ratio;
  return ContactProblem(model, problem.grid);
}

double largest(const ContactUnknowns& x) {
  return std::max(x.pressure.cwiseAbs().maxCoeff(), x.shear_x.cwiseAbs().maxCoeff());
}

bool same_laws(const ActiveLaws& a, const ActiveLaws& b) { return a.contact == b.contact && a.zone == b.zone; }

/// Takes away what rounding left at nodes outside the contact.
void clear_outside(ContactUnknowns& x, const ActiveLaws& laws) {
  ContactMask inside(static_cast<std::size_t>(x.pressure.size()), 0);
  for (const Eigen::Index node : laws.contact) inside[static_cast<std::size_t>(node)] = 1;
  for (Vector* field : {&x.pressure, &x.shear_x, &x.shear_y})
    for (Eigen::Index i = 0; i < field->size(); ++i)
      if (!inside[static_cast<std::size_t>(i)]) (*field)(i) = 0;
}

/// Nodes whose law differs between two choices, each with its law in the second.
std::vector<std::pair<Eigen::Index, Zone>> changed_laws(const ActiveLaws& before, const ActiveLaws& after,
                                                        Eigen::Index size) {
  const auto on_grid = [&](const ActiveLaws& laws) {
    std::vector<Zone> zones(static_cast<std::size_t>(size), Zone::free);
    for (std::size_t i = 0; i < laws.contact.size(); ++i)
      zones[static_cast<std::size_t>(laws.contact[i])] = laws.zone[i];
    return zones;
  };
  const std::vector<Zone> old_zones = on_grid(before), new_zones = on_grid(after);
  std::vector<std::pair<Eigen::Index, Zone>> changed;
  for (std::size_t i = 0; i < new_zones.size(); ++i)
    if (new_zones[i] != old_zones[i]) changed.emplace_back(static_cast<Eigen::Index>(i), new_zones[i]);
  return changed;
}

ContactUnknowns sum(ContactUnknowns x, double factor, const ContactUnknowns& y) { return x.add(factor, y); }

}  // namespace

RotationPath::RotationPath(const ContactProblem& problem, const ContactLevel& level,
                           const ContactUnknowns& frictionless, const NewtonOptions& options)
    : level_(&level),
      options_(options),
      turning_(with_drive(problem, Drive::rotation, 1)),
      freely_(with_drive(problem, Drive::free, 1)),
      step_(options.first_turn) {
  freely_.of_coating = {};  // its row measures progress alone
  options_.most_iterations = options.path_iterations;
  for (const double ratio : {1.0, 1.003, 0.997, 1.03, 0.97, 1.3, 0.7, 4.0, -2.0, 31.0, -29.0, 1e4, -1e4}) {
    if (std::optional<NewtonOutcome> found = solve_at(ratio, frictionless)) {
      here_ = std::move(*found);
      return;
    }
  }
}

std::optional<NewtonOutcome> RotationPath::solve_at(double ratio, const ContactUnknowns& start) const {
  ContactUnknowns first = start;
  first.rotation_ratio = ratio;
  NewtonOutcome outcome = newton_contact(turning_, *level_->table, *level_->influence, first, options_);
  iterations_ += outcome.iterations;
  if (!outcome.converged) return {};
  return outcome;
}

bool RotationPath::advance(double limit) {
  if (pivoting_) return pivot(limit);
  for (int attempt = 0; attempt < 4; ++attempt, step_ /= 4)
    if (step(limit)) return true;
  return false;
}

bool RotationPath::step(double limit) {
  double next = ratio() + direction_ * step_;
  if ((limit - ratio()) * direction_ > 0 && (limit - next) * direction_ < 0) next = limit;
  std::optional<NewtonOutcome> found = solve_at(next, here_.unknowns);
  if (!found) return false;
  here_ = std::move(*found);
  step_ *= options_.turn_growth;
  return true;
}

ActiveLaws RotationPath::laws_at(const ContactUnknowns& x) const {
  const ContactMask loaded = loaded_nodes(x);
  const NaturalMaps maps = natural_maps(turning_, *level_->influence, x, loaded);
  return choose_laws(turning_, *level_->influence, x, maps,
                     choose_contact(turning_, *level_->influence, x, maps, loaded));
}

/// core/newton/README.md, (N14)
std::optional<ContactUnknowns> RotationPath::tangent(const ActiveLaws& laws, const ContactUnknowns& measure) {
  const auto n = static_cast<Eigen::Index>(laws.contact.size());
  if (!turning_.lateral && std::count(laws.zone.begin(), laws.zone.end(), Zone::stick) == 0) {
    // A sliding cylinder's tractions do not know how fast it turns.
    ContactUnknowns turning = sum(here_.unknowns, -1, here_.unknowns);
    turning.rotation_ratio = 1;
    return turning;
  }
  ContactUnknowns along = measure;
  const double to_force = turning_.grid.cell_area() / largest(here_.unknowns);
  for (int pass = 0; pass < 2; ++pass) {
    require_time();
    freely_.drive.of_pressure = to_force * along.pressure;
    freely_.drive.of_shear_x = to_force * along.shear_x;
    if (turning_.lateral) freely_.drive.of_shear_y = to_force * along.shear_y;
    LawResiduals right;
    right.normal = right.shear_x = right.shear_y = Vector::Zero(n);
    right.drive = freely_.drive(along.pressure, along.shear_x, along.shear_y);
    const NewtonSystem system(freely_, *level_->influence, laws);
    const LinearStep linear = static_cast<int>(3 * n) <= options_.factorisable_unknowns
                                  ? system.solve_dense(*level_->table, right)
                                  : system.solve_krylov(right, 1e-8, options_.most_krylov_vectors);
    const double size = linear.solved ? largest(linear.step) : 0;
    if (!(size > 0) || !std::isfinite(size)) return {};
    along = sum(linear.step, largest(here_.unknowns) / size - 1, linear.step);
  }
  return along;
}

std::optional<NewtonOutcome> RotationPath::correct(const ContactUnknowns& predicted, double reach) {
  NewtonOutcome outcome;
  if (turning_.lateral) {
    freely_.drive_target = freely_.drive(predicted.pressure, predicted.shear_x, predicted.shear_y);
    outcome = newton_contact(freely_, *level_->table, *level_->influence, predicted, options_);
    iterations_ += outcome.iterations;
    if (!outcome.converged) return {};
  } else {
    std::optional<NewtonOutcome> found = solve_at(predicted.rotation_ratio, predicted);
    if (!found) return {};
    outcome = std::move(*found);
  }
  if (turning_.lateral && largest(sum(outcome.unknowns, -1, predicted)) > (reach + 1e-5) * largest(here_.unknowns))
    return {};
  return outcome;
}

bool RotationPath::step_along_tangent(double amount, double reach) {
  const ActiveLaws old_laws = laws_at(here_.unknowns);
  tangent(old_laws, *tangent_);  // sets the measure of progress
  std::optional<NewtonOutcome> found = correct(sum(here_.unknowns, amount, *tangent_), reach * amount);
  if (!found) return false;
  const ContactUnknowns last = *tangent_;
  std::optional<ContactUnknowns> next = tangent(laws_at(found->unknowns), last);
  if (!next) return false;
  here_ = std::move(*found);
  const bool reversed = next->pressure.dot(last.pressure) + next->shear_x.dot(last.shear_x) < 0;
  tangent_ = reversed ? sum(*next, -2, *next) : *next;
  direction_ = tangent_->rotation_ratio > 0 ? 1 : -1;
  return true;
}

std::optional<RotationPath::Change> RotationPath::first_change(const ActiveLaws& old_laws) const {
  constexpr double furthest = 1e8;
  const auto laws_after = [&](double amount) { return laws_at(sum(here_.unknowns, amount, *tangent_)); };
  double low = 0, high = 1e-12;
  ActiveLaws new_laws;
  for (; high < furthest; high *= 4) {
    new_laws = laws_after(high);
    if (!same_laws(new_laws, old_laws)) break;
    low = high;
  }
  if (high >= furthest) return {};
  for (int bisection = 0; bisection < 80 && high - low > 1e-15 * high; ++bisection) {
    const double middle = 0.5 * (low + high);
    ActiveLaws laws = laws_after(middle);
    if (same_laws(laws, old_laws)) {
      low = middle;
    } else {
      high = middle;
      new_laws = std::move(laws);
    }
  }
  return Change{high, std::move(new_laws)};
}

bool RotationPath::pivot(double limit) {
  const ActiveLaws old_laws = laws_at(here_.unknowns);
  if (!tangent_) {
    tangent_ = tangent(old_laws, here_.unknowns);
    if (!tangent_) return false;
    if (tangent_->rotation_ratio * direction_ < 0) tangent_ = sum(*tangent_, -2, *tangent_);
  }
  const auto at = [&](double amount) { return sum(here_.unknowns, amount, *tangent_); };
  const bool limit_ahead = (limit - ratio()) * direction_ > 0;
  const auto go_to_limit = [&] {
    std::optional<NewtonOutcome> found = solve_at(limit, at((limit - ratio()) / tangent_->rotation_ratio));
    if (found) here_ = std::move(*found);
    return found.has_value();
  };
  const std::optional<Change> change = first_change(old_laws);
  if (!change) return limit_ahead && go_to_limit();
  ContactUnknowns kink = at(change->amount);
  if (limit_ahead && (limit - kink.rotation_ratio) * direction_ <= 0 && go_to_limit()) return true;
  clear_outside(kink, change->laws);
  // Into the new laws, not back: by what becomes of the node that changed its law.
  const auto changed = changed_laws(old_laws, change->laws, turning_.grid.size());
  const auto changes_at = [&](const ContactUnknowns& x) {
    const auto all = changed_laws(old_laws, laws_at(x), turning_.grid.size());
    return std::all_of(changed.begin(), changed.end(),
                       [&](const auto& one) { return std::find(all.begin(), all.end(), one) != all.end(); });
  };
  if (const std::optional<ContactUnknowns> onward = tangent(change->laws, *tangent_))
    for (double amount = 1e-10; amount < 0.1; amount *= 10)
      for (const int sign : {1, -1}) {
        const ContactUnknowns further = sum(kink, sign * amount, *onward);
        if (!changes_at(further) || changes_at(sum(kink, -sign * amount, *onward))) continue;
        std::optional<NewtonOutcome> found = correct(further, 2 * std::max(change->amount, amount));
        if (!found) continue;
        here_ = std::move(*found);
        tangent_ = sign > 0 ? *onward : sum(*onward, -2, *onward);
        direction_ = tangent_->rotation_ratio > 0 ? 1 : -1;
        step_ = options_.first_turn;
        return true;
      }
  // A sphere's path is curved: the kink may lie elsewhere, but nearer to it the tangent knows better.
  if (!turning_.lateral || change->amount < 1e-9) return false;
  for (const double reach : {0.5, 1.0})
    for (const double share : {0.9, 0.5, 0.1, 0.02})
      if (step_along_tangent(share * change->amount, reach)) return true;
  return false;
}

}  // namespace rollres
