#include "core/paper_method/normal_contact.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <set>

#include "core/model/indenter_shape.hpp"
#include "core/numerics/solution_limits.hpp"

namespace rollres {

NormalContactSolver::NormalContactSolver(const ContactModel& model, const InfluenceTable& table,
                                         const SurfaceGrid& grid)
    : grid_(grid),
      ww_(displacement_kernel(table, grid, Direction::w, Direction::w)),
      wu_(displacement_kernel(table, grid, Direction::w, Direction::u)),
      load_given_(model.load.has_value()),
      load_(model.load.value_or(0)),
      approach_(model.approach.value_or(0)),
      largest_tension_(model.adhesion_threshold * grid.cell_area()),
      scale_(table(Direction::w, Direction::w, 0)),
      all_(grid.size()),
      system_(grid.size() + 1, [this](int row, int column) { return element(row, column); }) {
  if (model.dimension == 3) wv_ = displacement_kernel(table, grid, Direction::w, Direction::v);
  std::iota(all_.begin(), all_.end(), 0);
  const IndenterShape shape(model);
  profile_.resize(grid.size());
  of_normal_.resize(grid.size());
  of_shear_.resize(grid.size());
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const int node = grid.index(column, row);
      const double x = grid.x(column), y = grid.y(row);
      profile_[node] = shape.covers(x, y) ? shape.profile(x, y) : std::numeric_limits<double>::infinity();
      of_normal_[node] = shape.load(x, y).of_pressure;
      of_shear_[node] = shape.load(x, y).of_shear_x;
    }
}

double NormalContactSolver::element(int row, int column) const {
  const int approach = grid_.size();
  if (row == approach) return column == approach ? 0 : scale_ * of_normal_[column];
  return column == approach ? scale_ : ww_(row, column);
}

std::vector<int> NormalContactSolver::first_contact() const {
  std::vector<int> contact;
  if (largest_tension_ > 0) {
    std::copy_if(all_.begin(), all_.end(), std::back_inserter(contact),
                 [&](int node) { return std::isfinite(profile_[node]); });
    return contact;
  }
  Eigen::Index lowest = 0;
  profile_.minCoeff(&lowest);
  return {static_cast<int>(lowest)};
}

Eigen::VectorXd NormalContactSolver::lift_of(const Eigen::VectorXd& shear_x, const Eigen::VectorXd& shear_y) const {
  std::vector<int> sheared;
  for (const int node : all_)
    if (shear_x[node] != 0 || (shear_y.size() > 0 && shear_y[node] != 0)) sheared.push_back(node);
  Eigen::VectorXd lift = Eigen::VectorXd::Zero(grid_.size());
  if (sheared.empty()) return lift;
  wu_.add(all_, sheared, shear_x, lift);
  if (shear_y.size() > 0) wv_.add(all_, sheared, shear_y, lift);
  return lift;
}

bool NormalContactSolver::press(NormalContact& state, const Eigen::VectorXd& lift, const Eigen::VectorXd& shear_x) {
  std::vector<int> unknowns = state.contact;
  const auto n = static_cast<Eigen::Index>(unknowns.size());
  if (load_given_) unknowns.push_back(grid_.size());
  Eigen::VectorXd rhs(static_cast<Eigen::Index>(unknowns.size()));
  for (Eigen::Index k = 0; k < n; ++k)
    rhs[k] = profile_[unknowns[k]] - lift[unknowns[k]] - (load_given_ ? 0 : approach_);
  if (load_given_) rhs[n] = scale_ * (of_shear_.dot(shear_x) - load_);
  const Eigen::VectorXd solution = system_.solve(unknowns, rhs);
  ++state.iterations;
  state.approach = load_given_ ? scale_ * solution[n] : approach_;
  state.force.setZero(grid_.size());
  for (Eigen::Index k = 0; k < n; ++k) state.force[unknowns[k]] = solution[k];
  return solution.allFinite();
}

std::vector<int> NormalContactSolver::conflicts_of(const NormalContact& state, const Eigen::VectorXd& lift) const {
  std::vector<int> candidates, conflicts;
  std::set_difference(all_.begin(), all_.end(), state.contact.begin(), state.contact.end(),
                      std::back_inserter(candidates));
  std::erase_if(candidates, [&](int node) { return std::isinf(profile_[node]); });
  Eigen::VectorXd rise = lift(candidates);
  ww_.add(candidates, state.contact, state.force, rise);
  const double hair = 1e-11 * std::abs(state.approach);
  for (std::size_t k = 0; k < candidates.size(); ++k)
    if (rise[k] > profile_[candidates[k]] - state.approach + hair) conflicts.push_back(candidates[k]);
  return conflicts;
}

std::vector<int> NormalContactSolver::tense_of(const NormalContact& state) const {
  double largest = largest_tension_ + 1e-12 * state.force.cwiseAbs().maxCoeff();
  if (largest_tension_ > 0) largest = std::max(largest, 0.5 * state.force.maxCoeff());
  std::vector<int> tense;
  std::copy_if(state.contact.begin(), state.contact.end(), std::back_inserter(tense),
               [&](int node) { return state.force[node] > largest; });
  return tense;
}

std::vector<int> NormalContactSolver::one_doubling(const std::vector<int>& contact,
                                                   const std::vector<int>& conflicts) const {
  auto limits = [&](auto coordinate) {
    int least = std::numeric_limits<int>::max(), largest = -1;
    for (const int node : contact) {
      least = std::min(least, coordinate(node));
      largest = std::max(largest, coordinate(node));
    }
    const int margin = std::max(1, (largest - least + 1) / 2);
    return std::pair(least - margin, largest + margin);
  };
  auto column = [&](int node) { return node % grid_.columns; };
  auto row = [&](int node) { return node / grid_.columns; };
  const auto columns = limits(column), rows = limits(row);
  auto inside = [](std::pair<int, int> range, int place) { return place >= range.first && place <= range.second; };
  std::vector<int> near;
  for (const int node : conflicts)
    if (inside(columns, column(node)) && inside(rows, row(node))) near.push_back(node);
  return near.empty() ? conflicts : near;
}

NormalContact NormalContactSolver::solve(const Eigen::VectorXd& shear_x, const Eigen::VectorXd& shear_y,
                                         std::vector<int> start) {
  const Eigen::VectorXd lift = lift_of(shear_x, shear_y);
  NormalContact state;
  state.contact = start.empty() ? first_contact() : std::move(start);
  std::set<std::vector<int>> seen;
  bool one_by_one = false;
  for (const int limit = 200 + 2 * grid_.size(); state.iterations < limit;) {
    require_time();
    if (!press(state, lift, shear_x)) {
      state.reason = "the normal-contact system is singular";
      return state;
    }
    const std::vector<int> conflicts = conflicts_of(state, lift), tense = tense_of(state);
    if (conflicts.empty() && tense.empty()) {
      state.converged = true;
      return state;
    }
    if (!one_by_one && !seen.insert(state.contact).second) one_by_one = true;
    std::vector<int> change = conflicts.empty() ? tense : one_doubling(state.contact, conflicts);
    if (one_by_one) change = {std::max(conflicts.empty() ? -1 : conflicts.back(), tense.empty() ? -1 : tense.back())};
    std::vector<int> changed;
    std::set_symmetric_difference(state.contact.begin(), state.contact.end(), change.begin(), change.end(),
                                  std::back_inserter(changed));
    state.contact = std::move(changed);
    if (state.contact.empty()) {
      state.reason = "the body lifts off: no node is left in contact";
      return state;
    }
  }
  state.reason = "the contact area did not settle in " + std::to_string(state.iterations) + " iterations";
  return state;
}

}  // namespace rollres
