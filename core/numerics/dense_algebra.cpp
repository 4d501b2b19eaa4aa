#include "core/numerics/dense_algebra.hpp"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>

#include "core/numerics/solution_limits.hpp"

namespace rollres {

void SquareSystem::factorise(const Eigen::MatrixXd& matrix) {
  require_factorisation(static_cast<double>(matrix.rows()), "a factorisation");
  decomposition_.compute(matrix);
}

Eigen::MatrixXd SquareSystem::solve(const Eigen::MatrixXd& right_sides) const {
  return decomposition_.solve(right_sides);
}

Eigen::VectorXd SquareSystem::solve(const Eigen::VectorXd& right_side) const {
  return decomposition_.solve(right_side);
}

Eigen::MatrixXd SquareSystem::inverse() const {
  const Eigen::Index size = decomposition_.rows();
  return solve(Eigen::MatrixXd(Eigen::MatrixXd::Identity(size, size)));
}

SingularValues::SingularValues(const Eigen::MatrixXd& a) {
  const auto rows = static_cast<double>(a.rows()), columns = static_cast<double>(a.cols());
  constexpr double operations_per_second = 1e10;
  require_time(4 * rows * columns * std::min(rows, columns) / operations_per_second);
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(a, Eigen::ComputeThinU | Eigen::ComputeThinV);
  u = svd.matrixU();
  v = svd.matrixV();
  values = svd.singularValues();
}

Eigen::VectorXd SingularValues::least_squares(const Eigen::VectorXd& b) const {
  Eigen::VectorXd parts = u.transpose() * b;
  for (Eigen::Index k = 0; k < values.size(); ++k)
    parts[k] = values[k] > rank_limit * values[0] ? parts[k] / values[k] : 0;
  return v * parts;
}

Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  require_time();
  return a.colPivHouseholderQr().solve(b);
}

Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& a, std::optional<double> threshold) {
  const SingularValues parts(a);
  constexpr double rounding = 2.3e-16;
  const double least =
      threshold.value_or(rounding * static_cast<double>(std::max(a.rows(), a.cols()))) * parts.values(0);
  Eigen::MatrixXd scaled = parts.v;
  for (Eigen::Index k = 0; k < scaled.cols(); ++k) scaled.col(k) *= parts.values(k) > least ? 1 / parts.values(k) : 0;
  return scaled * parts.u.transpose();
}

}  // namespace rollres
