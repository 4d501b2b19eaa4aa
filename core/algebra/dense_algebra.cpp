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
  std::vector<Eigen::Index> free;
  const double negligible = 1e-12 * (a.transpose() * b).cwiseAbs().maxCoeff();
  std::vector<char> refused(static_cast<std::size_t>(n), 0);  // came back at once, nothing having moved since
  for (Eigen::Index round = 0; round < 3 * n; ++round) {
    const Eigen::VectorXd gradient = a.transpose() * (b - a * x);
    Eigen::Index steepest = -1;
    for (Eigen::Index j = 0; j < n; ++j)
      if (x[j] == 0 && !refused[static_cast<std::size_t>(j)] && gradient[j] > negligible &&
          (steepest < 0 || gradient[j] > gradient[steepest]))
        steepest = j;
    if (steepest < 0) break;
    free.push_back(steepest);
    const Eigen::VectorXd before = x;
    while (!free.empty()) {
      const Eigen::VectorXd wanted = least_squares(a(Eigen::all, free), b);
      double part = 1;  // of the way from x to what is wanted, so far as nothing turns negative
      for (std::size_t k = 0; k < free.size(); ++k)
        if (const auto i = static_cast<Eigen::Index>(k); wanted[i] <= 0)
          part = std::min(part, x[free[k]] / (x[free[k]] - wanted[i] + std::numeric_limits<double>::min()));
      std::vector<Eigen::Index> kept;
      for (std::size_t k = 0; k < free.size(); ++k) {
        const auto i = static_cast<Eigen::Index>(k);
        const double value = x[free[k]] + part * (wanted[i] - x[free[k]]);
        const bool stays = part == 1 || (wanted[i] > 0 && value > 0);
        x[free[k]] = stays ? value : 0;
        if (stays) kept.push_back(free[k]);
      }
      const bool done = part == 1;
      free = std::move(kept);
      if (done) break;
    }
    if (x == before)
      refused[static_cast<std::size_t>(steepest)] = 1;
    else
      std::fill(refused.begin(), refused.end(), char{0});
  }
  return x;
}

}  // namespace rollres
