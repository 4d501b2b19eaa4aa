#include "core/numerics/dense_algebra.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace rollres {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double rounding = std::numeric_limits<double>::epsilon();

/// Turns columns p and q by an angle: (p, q) becomes (c p - s q, s p + c q).
void turn(MatrixXd& matrix, Index p, Index q, double c, double s) {
  for (Index i = 0; i < matrix.rows(); ++i) {
    const double at_p = matrix(i, p), at_q = matrix(i, q);
    matrix(i, p) = c * at_p - s * at_q;
    matrix(i, q) = s * at_p + c * at_q;
  }
}

/// Turns columns p and q of a, and those of v with them, until they are orthogonal. Whether they were not.
bool make_orthogonal(MatrixXd& a, MatrixXd& v, Index p, Index q) {
  const double of_p = a.col(p).squaredNorm(), of_q = a.col(q).squaredNorm(), product = a.col(p).dot(a.col(q));
  if (!(std::abs(product) > rounding * std::sqrt(of_p) * std::sqrt(of_q))) return false;
  const double ratio = (of_q - of_p) / (2 * product);
  const double tangent = std::copysign(1 / (std::abs(ratio) + std::hypot(1, ratio)), ratio);
  const double c = 1 / std::hypot(1, tangent);
  turn(a, p, q, c, c * tangent);
  turn(v, p, q, c, c * tangent);
  return true;
}

}  // namespace

void SquareSystem::factorise(const MatrixXd& matrix) { decomposition_.compute(matrix); }

VectorXd SquareSystem::solve(const VectorXd& right_side) const { return solve(MatrixXd(right_side)); }

MatrixXd SquareSystem::solve(const MatrixXd& right_sides) const { return decomposition_.solve(right_sides); }

MatrixXd SquareSystem::inverse() const {
  return solve(MatrixXd(MatrixXd::Identity(decomposition_.rows(), decomposition_.rows())));
}

VectorXd least_squares(MatrixXd a, VectorXd b) {
  const Index n = a.cols();
  MatrixXd triangle = MatrixXd::Zero(n, n);
  VectorXd parts = VectorXd::Zero(n), norms(n);
  std::vector<Index> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), Index{0});
  Index rank = 0;
  for (; rank < std::min(n, a.rows()); ++rank) {
    Index pivot = rank;
    for (Index j = rank; j < n; ++j) {
      norms(j) = a.col(j).norm();
      if (norms(j) > norms(pivot)) pivot = j;
    }
    if (!(norms(pivot) > rounding * static_cast<double>(n) * triangle(0, 0))) break;
    a.col(rank).swap(a.col(pivot));
    triangle.col(rank).swap(triangle.col(pivot));
    std::swap(order[static_cast<std::size_t>(rank)], order[static_cast<std::size_t>(pivot)]);
    triangle(rank, rank) = norms(pivot);
    a.col(rank) /= norms(pivot);
    for (Index j = rank + 1; j < n; ++j) {
      triangle(rank, j) = a.col(rank).dot(a.col(j));
      a.col(j) -= triangle(rank, j) * a.col(rank);
    }
    parts(rank) = a.col(rank).dot(b);
    b -= parts(rank) * a.col(rank);
  }
  VectorXd x = VectorXd::Zero(n);
  for (Index k = rank - 1; k >= 0; --k) {
    parts(k) /= triangle(k, k);
    parts.head(k) -= parts(k) * triangle.col(k).head(k);
    x(order[static_cast<std::size_t>(k)]) = parts(k);
  }
  return x;
}

SingularValues::SingularValues(const MatrixXd& a) {
  const bool wide = a.cols() > a.rows();
  u = a;
  if (wide) u = a.transpose();
  const Index n = u.cols();
  v = MatrixXd::Identity(n, n);
  constexpr int most_sweeps = 60;  // ten are many
  bool turned = true;
  for (int sweep = 0; turned && sweep < most_sweeps; ++sweep) {
    turned = false;
    for (Index p = 0; p + 1 < n; ++p)
      for (Index q = p + 1; q < n; ++q) turned = make_orthogonal(u, v, p, q) || turned;
  }
  values.resize(n);
  for (Index k = 0; k < n; ++k) values(k) = u.col(k).norm();
  for (Index k = 0; k < n; ++k) {
    Index largest = k;
    for (Index j = k + 1; j < n; ++j)
      if (values(j) > values(largest)) largest = j;
    std::swap(values(k), values(largest));
    u.col(k).swap(u.col(largest));
    v.col(k).swap(v.col(largest));
    if (values(k) > 0) u.col(k) /= values(k);
  }
  if (wide) u.swap(v);
}

VectorXd SingularValues::least_squares(const VectorXd& b) const {
  VectorXd x = VectorXd::Zero(v.rows());
  for (Index k = 0; k < values.size(); ++k)
    if (values(k) > rank_limit * values(0)) x += u.col(k).dot(b) / values(k) * v.col(k);
  return x;
}

MatrixXd pseudo_inverse(const MatrixXd& a, std::optional<double> threshold) {
  const SingularValues svd(a);
  const double limit = threshold.value_or(rounding * static_cast<double>(svd.values.size()));
  MatrixXd inverse = MatrixXd::Zero(a.cols(), a.rows());
  for (Index k = 0; k < svd.values.size() && svd.values(k) > limit * svd.values(0); ++k)
    for (Index j = 0; j < a.rows(); ++j) inverse.col(j) += svd.u(j, k) / svd.values(k) * svd.v.col(k);
  return inverse;
}

}  // namespace rollres
