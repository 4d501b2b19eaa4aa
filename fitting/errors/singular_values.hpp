#pragma once

/// The singular value decomposition, compiled here once: it is costly to compile.

#include <Eigen/Core>

namespace rollres {

/// A = u diag(values) vᵀ with as many values as the shorter side of A, the largest first.
struct SingularValues {
  explicit SingularValues(const Eigen::MatrixXd& a);

  /// The largest value times so much counts as 0.
  static constexpr double rank_limit = 1e-12;

  /// The x of least |A x - b|, and of these that of least |x|.
  Eigen::VectorXd least_squares(const Eigen::VectorXd& b) const;

  Eigen::MatrixXd u, v;
  Eigen::VectorXd values;
};

}  // namespace rollres
