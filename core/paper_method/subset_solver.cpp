#include "core/paper_method/subset_solver.hpp"

#include <algorithm>

#include "core/messages/message_text.hpp"
#include "core/numerics/solution_limits.hpp"

namespace rollres {

SubsetSolver::SubsetSolver(int size, Element element, double largest_change)
    : element_(std::move(element)), largest_change_(largest_change), place_(size, -1), border_place_(size, -1) {}

void SubsetSolver::factorise(const std::vector<int>& set) {
  for (const int index : base_) place_[index] = -1;
  for (const int index : bordered_) border_place_[index] = -1;
  base_ = set;
  bordered_.clear();
  const auto n = static_cast<Eigen::Index>(base_.size());
  for (Eigen::Index k = 0; k < n; ++k) place_[base_[k]] = static_cast<int>(k);
  require_factorisation(static_cast<double>(n),
                        message_text("a factorisation for ", n, " nodes (give a larger spacing)"));
  Eigen::MatrixXd matrix(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    require_time();
    for (Eigen::Index i = 0; i < n; ++i) matrix(i, j) = element_(base_[i], base_[j]);
  }
  decomposition_.factorise(matrix);
  ++decompositions_;
  columns_.resize(n, 0);
  rows_.resize(0, n);
}

int SubsetSolver::border_of(int index, bool added) {
  if (border_place_[index] >= 0) return border_place_[index];
  const auto n = static_cast<Eigen::Index>(base_.size());
  const auto place = static_cast<Eigen::Index>(bordered_.size());
  if (place == columns_.cols()) {
    const Eigen::Index room = std::max<Eigen::Index>(8, 2 * place);
    columns_.conservativeResize(n, room);
    rows_.conservativeResize(room, n);
  }
  Eigen::VectorXd column = Eigen::VectorXd::Zero(n);
  if (added) {
    for (Eigen::Index i = 0; i < n; ++i) {
      column[i] = element_(base_[i], index);
      rows_(place, i) = element_(index, base_[i]);
    }
  } else {
    column[place_[index]] = 1;
    rows_.row(place).setZero();
    rows_(place, place_[index]) = 1;
  }
  columns_.col(place) = decomposition_.solve(column);
  bordered_.push_back(index);
  return border_place_[index] = static_cast<int>(place);
}

void SubsetSolver::prepare(const std::vector<int>& set) {
  set_ = set;
  added_.clear();
  removed_.clear();
  std::vector<char> kept(base_.size(), 0);
  for (const int index : set)
    if (place_[index] < 0)
      added_.push_back(index);
    else
      kept[place_[index]] = 1;
  for (std::size_t k = 0; k < base_.size(); ++k)
    if (!kept[k]) removed_.push_back(base_[k]);
  if (base_.empty() || added_.size() + removed_.size() > largest_change_ * static_cast<double>(base_.size())) {
    factorise(set);
    added_.clear();
    removed_.clear();
  }
  active_.clear();
  for (const int index : added_) active_.push_back(border_of(index, true));
  for (const int index : removed_) active_.push_back(border_of(index, false));
  const auto changed = static_cast<Eigen::Index>(active_.size());
  if (changed == 0) return;
  Eigen::MatrixXd schur = -(rows_(active_, Eigen::all) * columns_(Eigen::all, active_));
  for (std::size_t i = 0; i < added_.size(); ++i)
    for (std::size_t j = 0; j < added_.size(); ++j) schur(i, j) += element_(added_[i], added_[j]);
  schur_.factorise(schur);
}

Eigen::VectorXd SubsetSolver::solve(const std::vector<int>& set, const Eigen::VectorXd& rhs) {
  ++solutions_;
  if (set.empty()) return {};
  if (set != set_) prepare(set);
  Eigen::VectorXd base_rhs = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(base_.size()));
  Eigen::VectorXd border_rhs = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(active_.size()));
  for (std::size_t k = 0, next = 0; k < set.size(); ++k)
    if (place_[set[k]] >= 0)
      base_rhs[place_[set[k]]] = rhs[k];
    else
      border_rhs[next++] = rhs[k];
  Eigen::VectorXd base_solution = decomposition_.solve(base_rhs), border_solution;
  if (!active_.empty()) {
    border_rhs -= rows_(active_, Eigen::all) * base_solution;
    border_solution = schur_.solve(border_rhs);
    base_solution -= columns_(Eigen::all, active_) * border_solution;
  }
  Eigen::VectorXd solution(rhs.size());
  for (std::size_t k = 0, next = 0; k < set.size(); ++k)
    solution[k] = place_[set[k]] >= 0 ? base_solution[place_[set[k]]] : border_solution[next++];
  return solution;
}

}  // namespace rollres
