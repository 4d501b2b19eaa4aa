#include "core/paper_method/normal_contact.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <set>

#include "core/numerics/solution_limits.hpp"

namespace rollres {

double profile(const RollingScene& scene, double x, double y) {
  const double r2 = x * x + y * y, rest = scene.radius * scene.radius - r2;
  if (rest <= 0) return std::numeric_limits<double>::infinity();
  return r2 / (scene.radius + std::sqrt(rest));
}

NormalContactSolver::NormalContactSolver(const RollingScene& scene, const InfluenceTable& table,
                                         const SurfaceGrid& grid)
    : grid_(grid),
      ww_(displacement_kernel(table, grid, Direction::w, Direction::w)),
      wu_(displacement_kernel(table, grid, Direction::w, Direction::u)),
      load_given_(scene.load.has_value()),
      load_(scene.load.value_or(0)),
      approach_(scene.approach.value_or(0)),
      largest_tension_(scene.adhesion_threshold * grid.cell_area()),
      radius_(scene.radius),
      scale_(table(Direction::w, Direction::w, 0)),
      system_(grid.size() + 1, [this](int row, int column) { return element(row, column); }) {
  const bool sphere = scene.indenter == Indenter::sphere;
  if (sphere) wv_ = displacement_kernel(table, grid, Direction::w, Direction::v);
  profile_.resize(grid.size());
  upright_.setOnes(grid.size());
  lever_.setZero(grid.size());
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const int node = grid.index(column, row);
      const double x = grid.x(column), y = sphere ? grid.y(row) : 0;
      profile_[node] = profile(scene, x, y);
      if (sphere || std::isinf(profile_[node])) continue;
      lever_[node] = x / radius_;
      upright_[node] = std::sqrt(1 - lever_[node] * lever_[node]);
    }
}

double NormalContactSolver::element(int row, int column) const {
  const int approach = grid_.size();
  if (row == approach) return column == approach ? 0 : scale_ * upright_[column];
  return column == approach ? scale_ : ww_(row, column);
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
  const int size = grid_.size();
  std::vector<int> all(size), sheared;
  std::iota(all.begin(), all.end(), 0);
  for (const int node : all)
    if (shear_x[node] != 0 || (shear_y.size() > 0 && shear_y[node] != 0)) sheared.push_back(node);
  Eigen::VectorXd lift = Eigen::VectorXd::Zero(size);
  if (!sheared.empty()) {
    wu_.add(all, sheared, shear_x, lift);
    if (shear_y.size() > 0) wv_.add(all, sheared, shear_y, lift);
  }
  const double needed = load_given_ ? -load_ - lever_.dot(shear_x) : 0;

  NormalContact state;
  state.contact = std::move(start);
  if (state.contact.empty() && largest_tension_ > 0) {
    std::copy_if(all.begin(), all.end(), std::back_inserter(state.contact),
                 [&](int node) { return std::isfinite(profile_[node]); });
  } else if (state.contact.empty()) {
    Eigen::Index lowest = 0;
    profile_.minCoeff(&lowest);
    state.contact = {static_cast<int>(lowest)};
  }
  std::set<std::vector<int>> seen;
  bool one_by_one = false;
  for (const int limit = 200 + 2 * size; state.iterations < limit;) {
    require_time();
    std::vector<int> unknowns = state.contact;
    const auto n = static_cast<Eigen::Index>(unknowns.size());
    if (load_given_) unknowns.push_back(size);
    Eigen::VectorXd rhs(static_cast<Eigen::Index>(unknowns.size()));
    for (Eigen::Index k = 0; k < n; ++k)
      rhs[k] = profile_[unknowns[k]] - lift[unknowns[k]] - (load_given_ ? 0 : approach_);
    if (load_given_) rhs[n] = scale_ * needed;
    const Eigen::VectorXd solution = system_.solve(unknowns, rhs);
    ++state.iterations;
    state.approach = load_given_ ? scale_ * solution[n] : approach_;
    state.force.setZero(size);
    for (Eigen::Index k = 0; k < n; ++k) state.force[unknowns[k]] = solution[k];
    if (!solution.allFinite()) {
      state.reason = "the normal-contact system is singular";
      return state;
    }

    std::vector<char> in_contact(size, 0);
    for (const int node : state.contact) in_contact[node] = 1;
    std::vector<int> free_nodes, conflicts, tense;
    for (const int node : all)
      if (!in_contact[node] && std::isfinite(profile_[node])) free_nodes.push_back(node);
    Eigen::VectorXd rise = lift(free_nodes);
    ww_.add(free_nodes, state.contact, state.force, rise);
    const double hair = 1e-11 * std::abs(state.approach);
    for (std::size_t k = 0; k < free_nodes.size(); ++k)
      if (rise[k] > profile_[free_nodes[k]] - state.approach + hair) conflicts.push_back(free_nodes[k]);
    double largest = largest_tension_ + 1e-12 * state.force.cwiseAbs().maxCoeff();
    if (largest_tension_ > 0) largest = std::max(largest, 0.5 * state.force.maxCoeff());
    for (const int node : state.contact)
      if (state.force[node] > largest) tense.push_back(node);

    if (conflicts.empty() && tense.empty()) {
      state.converged = true;
      return state;
    }
    if (!one_by_one && !seen.insert(state.contact).second) one_by_one = true;
    std::vector<int> change = conflicts.empty() ? tense : one_doubling(state.contact, conflicts);
    if (one_by_one) change = {std::max(conflicts.empty() ? -1 : conflicts.back(), tense.empty() ? -1 : tense.back())};
    for (const int node : change) in_contact[node] = !in_contact[node];
    state.contact.clear();
    for (const int node : all)
      if (in_contact[node]) state.contact.push_back(node);
    if (state.contact.empty()) {
      state.reason = "the body lifts off: no node is left in contact";
      return state;
    }
  }
  state.reason = "the contact area did not settle in " + std::to_string(state.iterations) + " iterations";
  return state;
}

}  // namespace rollres
