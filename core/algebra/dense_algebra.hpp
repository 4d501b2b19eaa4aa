#pragma once

/// Dense decompositions of Eigen, each compiled here once: they are the costliest of its templates.

#include <Eigen/Core>

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
  Eigen::MatrixXd triangles_;
  Eigen::PermutationMatrix<Eigen::Dynamic> rows_;
};

/// A x = b with a symmetric A that is positive definite, A = L L^T by Cholesky.
class PositiveSystem {
 public:
  explicit PositiveSystem(const Eigen::MatrixXd& matrix);

  /// False if A is not positive definite; all else is then without meaning.
  bool definite() const { return definite_; }
  Eigen::VectorXd solve(const Eigen::VectorXd& right_side) const;
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right_sides) const;
  Eigen::MatrixXd inverse() const;
  const Eigen::MatrixXd& lower() const { return lower_; }
  /// ln sqrt(det A)
  double log_root_determinant() const;

 private:
  Eigen::MatrixXd lower_;
  bool definite_ = false;
};

/// The x of least |a x - b| where the columns of a are independent: a = Q R by Householder's reflections, without
/// pivots. Of a with fewer rows than columns the last unknowns are 0.
class OverdeterminedSystem {
 public:
  OverdeterminedSystem() = default;
  explicit OverdeterminedSystem(const Eigen::MatrixXd& a);

  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  /// R, with as many rows as the shorter side of a: |R x - Q^T b| has its least where |a x - b| has.
  Eigen::MatrixXd triangle() const;

 private:
  Eigen::MatrixXd reflections_;  // and R above them
  Eigen::VectorXd coefficients_;
};

/// The inverse of what stands on and above the diagonal of a square matrix.
Eigen::MatrixXd inverse_of_upper(const Eigen::MatrixXd& triangle);

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
