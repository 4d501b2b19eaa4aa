#pragma once

/// Right-preconditioned GMRES with restarts (Saad and Schultz 1986), for operators given as functions. Right
/// preconditioning leaves the residual what it is, so the tolerance is on the true residual.

#include <Eigen/Core>
#include <cmath>
#include <vector>

namespace rollres {

struct KrylovResult {
  Eigen::VectorXd x;
  int iterations = 0;
  double relative_residual = 1;
};

/// Solves apply(x) = b from x = 0.
/// @param apply, precondition  functions VectorXd -> VectorXd
template <class Apply, class Precondition>
KrylovResult gmres(const Apply& apply, const Precondition& precondition, const Eigen::VectorXd& b, double tolerance,
                   int most_iterations, int restart = 60) {
  KrylovResult result;
  result.x = Eigen::VectorXd::Zero(b.size());
  const double target = tolerance * b.norm();
  Eigen::VectorXd residual = b;
  double norm = b.norm();
  while (norm > target && norm > 0 && result.iterations < most_iterations) {
    static thread_local Eigen::MatrixXd basis;  // kept: large blocks are costly to get afresh for every system
    if (basis.rows() != b.size() || basis.cols() < restart + 1) basis.resize(b.size(), restart + 1);
    Eigen::MatrixXd hessenberg = Eigen::MatrixXd::Zero(restart + 1, restart);
    Eigen::VectorXd cosine(restart), sine(restart), g = Eigen::VectorXd::Zero(restart + 1);
    basis.col(0) = residual / norm;
    g(0) = norm;
    int k = 0;
    for (; k < restart && result.iterations < most_iterations; ++k) {
      ++result.iterations;
      Eigen::VectorXd next = apply(precondition(basis.col(k)));
      // Classical Gram-Schmidt, twice.
      for (int pass = 0; pass < 2; ++pass) {
        const Eigen::VectorXd along = basis.leftCols(k + 1).transpose() * next;
        next.noalias() -= basis.leftCols(k + 1) * along;
        hessenberg.col(k).head(k + 1) += along;
      }
      const double length = next.norm();
      hessenberg(k + 1, k) = length;
      if (length > 0) basis.col(k + 1) = next / length;
      for (int i = 0; i < k; ++i) {  // Givens rotations
        const double upper = hessenberg(i, k), lower = hessenberg(i + 1, k);
        hessenberg(i, k) = cosine(i) * upper + sine(i) * lower;
        hessenberg(i + 1, k) = -sine(i) * upper + cosine(i) * lower;
      }
      const double radius = std::hypot(hessenberg(k, k), hessenberg(k + 1, k));
      cosine(k) = radius > 0 ? hessenberg(k, k) / radius : 1;
      sine(k) = radius > 0 ? hessenberg(k + 1, k) / radius : 0;
      hessenberg(k, k) = radius;
      g(k + 1) = -sine(k) * g(k);
      g(k) *= cosine(k);
      if (std::abs(g(k + 1)) <= target || length == 0) {
        ++k;
        break;
      }
    }
    const Eigen::VectorXd y = hessenberg.topLeftCorner(k, k).template triangularView<Eigen::Upper>().solve(g.head(k));
    if (!y.allFinite()) break;
    result.x += precondition(basis.leftCols(k) * y);
    const double before = norm;
    if (std::abs(g(k)) <= target) {  // the recurrence's own residual; the caller recomputes his
      norm = std::abs(g(k));
      break;
    }
    residual = b - apply(result.x);
    norm = residual.norm();
    if (!(norm < 0.999 * before)) break;  // stagnation
  }
  result.relative_residual = b.norm() > 0 ? norm / b.norm() : 0;
  return result;
}

}  // namespace rollres
