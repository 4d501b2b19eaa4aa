#include "core/newton_contact.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

namespace rollres {

namespace {

using Mask = std::vector<char>;

/// Contact set by the normal law; a node in contact stays until its tension passes the adhesion threshold.
Mask choose_contact(const ContactProblem& problem, const InfluenceOperator& influence, const ContactUnknowns& x,
                    const NaturalMaps& maps, const Mask& before) {
  Mask now(before.size());
  for (std::size_t i = 0; i < now.size(); ++i) {
    const auto node = static_cast<Eigen::Index>(i);
    const double threshold = before[i] ? -problem.scene.adhesion_threshold : 0;
    now[i] = x.pressure(node) - maps.gap(node) / influence.self_normal() > threshold;
  }
  return now;
}

/// Sets tractions outside the contact to zero; true if anything changed.
bool release(ContactUnknowns& x, const Mask& contact) {
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

ActiveLaws choose_laws(const ContactProblem& problem, const InfluenceOperator& influence, const ContactUnknowns& x,
                       const NaturalMaps& maps, const Mask& contact, bool all_stick) {
  ActiveLaws laws;
  for (std::size_t i = 0; i < contact.size(); ++i)
    if (contact[i]) laws.contact.push_back(static_cast<Eigen::Index>(i));
  const auto n = static_cast<Eigen::Index>(laws.contact.size());
  laws.zone.assign(laws.contact.size(), Zone::stick);
  laws.direction_x = laws.direction_y = laws.beta = Vector::Zero(n);
  if (!problem.friction || all_stick) return laws;
  const double per_slip = 1 / influence.self_slip();
  bool sticking = false;
  Eigen::Index closest = 0;  // to sticking
  double least_excess = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index node = laws.contact[static_cast<std::size_t>(i)];
    const double qx = x.shear_x(node) + maps.slip_x(node) * per_slip;
    const double qy = problem.sphere ? x.shear_y(node) + maps.slip_y(node) * per_slip : 0;
    const double size = std::hypot(qx, qy);
    const double bound = problem.scene.friction_coefficient * std::abs(x.pressure(node));
    if (size <= bound) {
      sticking = true;
      continue;
    }
    if (size - bound < least_excess) {
      least_excess = size - bound;
      closest = i;
    }
    laws.zone[static_cast<std::size_t>(i)] = Zone::slip;
    laws.direction_x(i) = qx / size;
    laws.direction_y(i) = qy / size;
    laws.beta(i) = bound / size;
  }
  // Without any sticking node of a cylinder the drive could not determine the rotation; a sphere's slip also has a
  // direction, which the rotation turns.
  if (!sticking && n > 0 && !problem.rotation_given() && !problem.sphere)
    laws.zone[static_cast<std::size_t>(closest)] = Zone::stick;
  return laws;
}

LawResiduals residuals(const ContactProblem& problem, const InfluenceOperator& influence, const ContactUnknowns& x,
                       const NaturalMaps& maps, const ActiveLaws& laws) {
  const auto n = static_cast<Eigen::Index>(laws.contact.size());
  LawResiduals right;
  right.normal.resize(n);
  const double friction = problem.scene.friction_coefficient;
  if (problem.friction) right.shear_x = right.shear_y = Vector::Zero(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index node = laws.contact[static_cast<std::size_t>(i)];
    right.normal(i) = -maps.gap(node) / influence.self_normal();
    if (!problem.friction) continue;
    if (laws.zone[static_cast<std::size_t>(i)] == Zone::stick) {
      right.shear_x(i) = maps.slip_x(node) / influence.self_slip();
      if (problem.sphere) right.shear_y(i) = maps.slip_y(node) / influence.self_slip();
    } else {
      const double bound = friction * std::abs(x.pressure(node));
      right.shear_x(i) = bound * laws.direction_x(i) - x.shear_x(node);
      if (problem.sphere) right.shear_y(i) = bound * laws.direction_y(i) - x.shear_y(node);
    }
    if (problem.sphere && problem.grid.first_row + node / problem.grid.columns == 0)
      right.shear_y(i) = -x.shear_y(node);
  }
  const Vector none = Vector::Zero(x.pressure.size());
  const Vector& shear = problem.friction ? x.shear_x : none;
  if (problem.load_given()) right.load = *problem.scene.load - problem.load(x.pressure, shear);
  if (problem.friction && !problem.rotation_given())
    right.drive = problem.drive_target - problem.drive(x.pressure, shear);
  return right;
}

/// Tolerance of the linear solution: what the step can gain, as the maps converge quadratically, and no more than the
/// last step needs.
double forcing(double residual, const NewtonOptions& options) {
  const double last = 0.05 * options.tolerance / residual;
  return std::clamp(std::max(residual, last), 1e-5, 2e-2);
}

bool touches_border(const ContactProblem& problem, const Mask& contact) {
  const SurfaceGrid& grid = problem.grid;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      if (contact[static_cast<std::size_t>(grid.index(column, row))] &&
          (column == 0 || column == grid.columns - 1 || (problem.sphere && row == grid.rows - 1)))
        return true;
  return false;
}

}  // namespace

NaturalMaps natural_maps(const ContactProblem& problem, const InfluenceOperator& influence, const ContactUnknowns& x,
                         const std::vector<char>& in_contact) {
  NaturalMaps maps;
  maps.moved = influence.apply(x.pressure, x.shear_x, x.shear_y);
  const SurfaceGrid& grid = problem.grid;
  const Eigen::Index size = grid.size();
  maps.gap.resize(size);
  if (problem.friction) {
    maps.slip_x.resize(size);
    if (problem.sphere) maps.slip_y.resize(size);
  }
  const double scale = std::max(x.pressure.cwiseAbs().maxCoeff(), 1e-300);
  const double friction = problem.scene.friction_coefficient;
  const double per_friction = 1 / std::min(1.0, std::max(friction, 1e-300));  // shear is measured by mu p
  const auto count = [&](double residual) {
    const double relative = std::abs(residual) / scale;
    maps.largest = std::max(maps.largest, relative);
    maps.mean_square += relative * relative;
  };
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const Eigen::Index i = grid.index(column, row), at = static_cast<Eigen::Index>(row) * (grid.columns + 1) + column;
      maps.gap(i) = problem.profile(i) - x.approach - maps.moved.w(at);
      const double gap = maps.gap(i) / influence.self_normal(), pressure = x.pressure(i);
      if (problem.scene.adhesion_threshold > 0) {
        if (in_contact[static_cast<std::size_t>(i)]) {
          count(gap);
          count(std::min(0.0, pressure + problem.scene.adhesion_threshold));
        } else {
          count(std::min(0.0, gap));
        }
      } else {
        count(pressure - std::max(0.0, pressure - gap));
      }
      if (!problem.friction) continue;
      maps.slip_x(i) =
          1 + (maps.moved.u(at + 1) - maps.moved.u(at)) / grid.spacing_x - x.rotation_ratio * problem.rolling_radius(i);
      if (problem.sphere) maps.slip_y(i) = (maps.moved.v(at + 1) - maps.moved.v(at)) / grid.spacing_x;
      const double bound = friction * std::abs(pressure);
      if (bound == 0 && x.shear_x(i) == 0) continue;
      const double qx = x.shear_x(i) + maps.slip_x(i) / influence.self_slip();
      const double qy =
          problem.sphere && grid.first_row + row > 0 ? x.shear_y(i) + maps.slip_y(i) / influence.self_slip() : 0;
      const double length = std::hypot(qx, qy), factor = length > bound ? bound / length : 1;
      count((x.shear_x(i) - factor * qx) * per_friction);
      if (problem.sphere) count((x.shear_y(i) - factor * qy) * per_friction);
    }
  const Vector none = Vector::Zero(size);
  const Vector& shear = problem.friction ? x.shear_x : none;
  if (problem.load_given()) {
    const double missing = *problem.scene.load - problem.load(x.pressure, shear);
    count(missing / *problem.scene.load * scale);
  }
  if (problem.friction && !problem.rotation_given()) {
    const double force = std::max(problem.load(x.pressure, shear), 1e-300);
    count((problem.drive_target - problem.drive(x.pressure, shear)) / force * scale);
  }
  return maps;
}

NewtonOutcome newton_contact(const ContactProblem& problem, const InfluenceTable& table,
                             const InfluenceOperator& influence, const ContactUnknowns& start,
                             const NewtonOptions& options) {
  NewtonOutcome outcome;
  ContactUnknowns x = start;
  Mask contact(static_cast<std::size_t>(problem.grid.size()));
  for (std::size_t i = 0; i < contact.size(); ++i) contact[i] = x.pressure(static_cast<Eigen::Index>(i)) != 0;
  NaturalMaps maps = natural_maps(problem, influence, x, contact);
  ContactUnknowns best = x;
  double best_norm = std::numeric_limits<double>::infinity();
  std::deque<double> recent;
  constexpr std::size_t memory = 4;  // of the non-monotone acceptance
  bool first = true;

  for (; outcome.iterations < options.most_iterations; ++outcome.iterations) {
    if (!first && maps.largest <= options.tolerance) break;
    // On the first step the contact of the start is held: its gaps may mean nothing yet.
    const Mask chosen = first ? contact : choose_contact(problem, influence, x, maps, contact);
    ContactUnknowns base = x;
    NaturalMaps base_maps = maps;
    if (release(base, chosen)) base_maps = natural_maps(problem, influence, base, chosen);
    const ActiveLaws laws = choose_laws(problem, influence, base, base_maps, chosen, first && options.first_all_stick);
    if (laws.contact.empty()) break;

    const NewtonSystem system(problem, influence, laws);
    const LawResiduals right = residuals(problem, influence, base, base_maps, laws);
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
