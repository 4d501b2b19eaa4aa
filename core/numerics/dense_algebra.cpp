#include "core/numerics/dense_algebra.hpp"

#include <Eigen/QR>

namespace rollres {

void SquareSystem::factorise(const Eigen::MatrixXd& matrix) { decomposition_.compute(matrix); }

Eigen::VectorXd SquareSystem::solve(const Eigen::VectorXd& right_side) const {
  return decomposition_.solve(right_side);
}

Eigen::MatrixXd SquareSystem::solve(const Eigen::MatrixXd& right_sides) const {
  return decomposition_.solve(right_sides);
}

Eigen::MatrixXd SquareSystem::inverse() const { return decomposition_.inverse(); }

Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  return a.colPivHouseholderQr().solve(b);
}

Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& a, std::optional<double> threshold) {
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
  if (threshold) decomposition.setThreshold(*threshold);
  return decomposition.compute(a).pseudoInverse();
}

}  // namespace rollres
