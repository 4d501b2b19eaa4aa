#include "core/algebra/dense_algebra.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

#include <algorithm>
#include <limits>
#include <vector>

#include "core/numerics/solution_limits.hpp"

namespace rollres {

namespace {

using Eigen::Lower, Eigen::UnitLower, Eigen::Upper;

template <typename RightSide>
RightSide solved_by_rows(const Eigen::MatrixXd& triangles, const Eigen::PermutationMatrix<Eigen::Dynamic>& rows,
                         const RightSide& right_side) {
  RightSide x = rows * right_side;
  triangles.triangularView<UnitLower>().solveInPlace(x);
  triangles.triangularView<Upper>().solveInPlace(x);
  return x;
}

template <typename RightSide>
RightSide solved_by_root(const Eigen::MatrixXd& lower, RightSide x) {
  lower.triangularView<Lower>().solveInPlace(x);
  lower.transpose().triangularView<Upper>().solveInPlace(x);
  return x;
}

}  // namespace

void SquareSystem::factorise(const Eigen::MatrixXd& matrix) {
  require_factorisation(static_cast<double>(matrix.rows()), "a factorisation");
  triangles_ = matrix;
  rows_ = Eigen::PartialPivLU<Eigen::Ref<Eigen::MatrixXd>>(triangles_).permutationP();
}

Eigen::MatrixXd SquareSystem::solve(const Eigen::MatrixXd& right_sides) const {
  return solved_by_rows(triangles_, rows_, right_sides);
}

Eigen::VectorXd SquareSystem::solve(const Eigen::VectorXd& right_side) const {
  return solved_by_rows(triangles_, rows_, right_side);
}

Eigen::MatrixXd SquareSystem::inverse() const {
  const Eigen::Index size = triangles_.rows();
  return solve(Eigen::MatrixXd(Eigen::MatrixXd::Identity(size, size)));
}

PositiveSystem::PositiveSystem(const Eigen::MatrixXd& matrix) {
  const Eigen::LLT<Eigen::MatrixXd> factor(matrix);
  lower_ = factor.matrixL();
  definite_ = factor.info() == Eigen::Success;
}

Eigen::VectorXd PositiveSystem::solve(const Eigen::VectorXd& right_side) const {
  return solved_by_root(lower_, right_side);
}

Eigen::MatrixXd PositiveSystem::solve(const Eigen::MatrixXd& right_sides) const {
  return solved_by_root(lower_, right_sides);
}

Eigen::MatrixXd PositiveSystem::inverse() const {
  return solve(Eigen::MatrixXd(Eigen::MatrixXd::Identity(lower_.rows(), lower_.cols())));
}

double PositiveSystem::log_root_determinant() const { return lower_.diagonal().array().log().sum(); }

OverdeterminedSystem::OverdeterminedSystem(const Eigen::MatrixXd& a) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> decomposition(a);
  reflections_ = decomposition.matrixQR();
  coefficients_ = decomposition.hCoeffs();
}

Eigen::VectorXd OverdeterminedSystem::solve(const Eigen::VectorXd& b) const {
  Eigen::VectorXd turned = b;
  turned.applyOnTheLeft(Eigen::householderSequence(reflections_, coefficients_).adjoint());
  const Eigen::Index rank = coefficients_.size();
  Eigen::VectorXd known = turned.head(rank), x = Eigen::VectorXd::Zero(reflections_.cols());
  reflections_.topLeftCorner(rank, rank).triangularView<Upper>().solveInPlace(known);
  x.head(rank) = known;
  return x;
}

Eigen::MatrixXd OverdeterminedSystem::triangle() const {
  return reflections_.topRows(coefficients_.size()).triangularView<Upper>();
}

Eigen::MatrixXd inverse_of_upper(const Eigen::MatrixXd& triangle) {
  return triangle.triangularView<Upper>().solve(Eigen::MatrixXd::Identity(triangle.rows(), triangle.cols()));
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

namespace {

/// Q^T (a b) of a least squares |a x - b| whose unknowns come and go. The columns of a that are in use, in the order in
/// which they came, are an upper triangle; below it stands what they leave of the other columns and of b.
class ColumnsInUse {
 public:
  ColumnsInUse(const Eigen::MatrixXd& a, const Eigen::VectorXd& b)
      : sizes_(a.colwise().norm()), turned_(a.rows(), a.cols() + 1) {
    turned_ << a, b;
  }

  const std::vector<Eigen::Index>& columns() const { return used_; }

  /// a^T (b - a x) at the x of least squares.
  Eigen::VectorXd slopes() const {
    const auto left = turned_.bottomRows(turned_.rows() - count());
    return left.leftCols(sizes_.size()).transpose() * left.rightCols<1>();
  }

  /// The x of least squares, of the columns in use.
  Eigen::VectorXd solution() const {
    const Eigen::MatrixXd triangle = turned_(Eigen::seqN(0, count()), used_);
    Eigen::VectorXd x = turned_.rightCols<1>().head(count());
    triangle.triangularView<Upper>().solveInPlace(x);
    return x;
  }

  /// False, and nothing is changed, for a column that depends on those in use.
  bool add(Eigen::Index column) {
    constexpr double dependent = 1e-14;
    auto left = turned_.bottomRows(turned_.rows() - count());
    if (left.rows() == 0 || left.col(column).norm() <= dependent * sizes_[column]) return false;
    Eigen::VectorXd reflection(left.rows() - 1), work(turned_.cols());
    double factor = 0, size = 0;
    left.col(column).makeHouseholder(reflection, factor, size);
    left.applyHouseholderOnTheLeft(reflection, factor, work.data());
    left.col(column).setZero();
    left(0, column) = size;
    used_.push_back(column);
    return true;
  }

  /// Takes out the column in use at a place of columns().
  void remove(Eigen::Index place) {
    used_.erase(used_.begin() + place);
    for (Eigen::Index row = place; row < count(); ++row) {  // a row too many stands in each column behind it
      Eigen::JacobiRotation<double> rotation;
      rotation.makeGivens(turned_(row, used_[row]), turned_(row + 1, used_[row]));
      turned_.applyOnTheLeft(row, row + 1, rotation.adjoint());
      turned_(row + 1, used_[row]) = 0;
    }
  }

 private:
  Eigen::Index count() const { return std::ssize(used_); }

  Eigen::VectorXd sizes_;
  Eigen::MatrixXd turned_;
  std::vector<Eigen::Index> used_;
};

}  // namespace

Eigen::VectorXd nonnegative_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  const Eigen::Index n = a.cols();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
  if (n == 0) return x;
  if (a.rows() > 2 * n) {  // a triangle has the same least squares
    Eigen::MatrixXd all(a.rows(), n + 1);
    all << a, b;
    const Eigen::MatrixXd triangle = OverdeterminedSystem(all).triangle();
    return nonnegative_least_squares(triangle.leftCols(n), triangle.col(n));
  }
  ColumnsInUse used(a, b);
  const double negligible = 1e-12 * used.slopes().cwiseAbs().maxCoeff();
  Eigen::Array<bool, Eigen::Dynamic, 1> refused(n);  // came back at once, nothing having moved since
  refused.setConstant(false);
  for (Eigen::Index round = 0; round < 3 * n; ++round) {
    require_time();
    Eigen::Index steepest = 0;
    if ((x.array() == 0 && !refused).select(used.slopes(), 0).maxCoeff(&steepest) <= negligible) break;
    const Eigen::VectorXd before = x;
    for (bool done = !used.add(steepest); !done;) {
      const Eigen::VectorXd wanted = used.solution();
      double part = 1;  // of the way from x to what is wanted, so far as nothing turns negative
      const auto& columns = used.columns();
      for (Eigen::Index i = 0; i < wanted.size(); ++i)
        if (wanted[i] <= 0)
          part = std::min(part, x[columns[i]] / (x[columns[i]] - wanted[i] + std::numeric_limits<double>::min()));
      done = part == 1;
      for (Eigen::Index i = wanted.size() - 1; i >= 0; --i) {
        double& value = x[columns[i]];
        value += part * (wanted[i] - value);
        if (done || (wanted[i] > 0 && value > 0)) continue;
        value = 0;
        used.remove(i);
      }
    }
    if (x == before)
      refused[steepest] = true;
    else
      refused.setConstant(false);
  }
  return x;
}

}  // namespace rollres
