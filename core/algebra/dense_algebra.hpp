#pragma once

/// Dense decompositions of Eigen, each compiled here once: they are the costliest of its templates.

#include <Eigen/Core>
#include <Eigen/LU>

#include <optional>

namespace rollres {

/// A x = b with a square A, by LU decomposition with row pivots. A singular A gives numbers that are not finite.
class SquareSystem {
 public:
  SquareSystem() = default;
  explicit SquareSystem(const Eigen::MatrixXd& matrix) { factorise(matrix); }

  void factorise(const Eigen::MatrixXd& matrix);
  Eigen::VectorXd solve(const Eigen::VectorXd& right_side) const;
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right_sides) const;
  Eigen::MatrixXd inverse() const;

 private:
  Eigen::PartialPivLU<Eigen::MatrixXd> decomposition_;
};

/// a = u diag(values) v^T with as many values as the shorter side of a, the largest first.
struct SingularValues {
  explicit SingularValues(const Eigen::MatrixXd& a);

  /// The largest value times so much counts as 0.
  static constexpr double rank_limit = 1e-12;

  /// The x of least |a x - b|, and of these that of least |x|.
  Eigen::VectorXd least_squares(const Eigen::VectorXd& b) const;

  Eigen::MatrixXd u, v;
  Eigen::VectorXd values;
};

/// The x of least |a x - b|, by QR decomposition with column pivots.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/// The inverse of Moore and Penrose.
/// @param threshold singular values below so much of the largest count as 0; absent: about the rounding
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& a, std::optional<double> threshold = {});

/// The x >= 0 with the least |A x - b| (Lawson and Hanson 1974, Solving Least Squares Problems, chapter 23).
Eigen::VectorXd nonnegative_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

}  // namespace rollres
