#pragma once

/// Right-preconditioned GMRES with restarts (Saad and Schultz 1986), for operators given as functions. Right
/// preconditioning leaves the residual what it is, so the tolerance is on the true residual.

#include <Eigen/Core>
#include <cmath>

#include "core/numerics/solution_limits.hpp"

namespace rollres {

template <class Real>
struct KrylovResult {
  Eigen::Matrix<Real, Eigen::Dynamic, 1> x;
  int iterations = 0;
  double relative_residual = 1;
};

/// Solves apply(x) = b from x = 0.
/// @param apply, precondition  functions vector -> vector
template <class Real, class Apply, class Precondition>
KrylovResult<Real> gmres(const Apply& apply, const Precondition& precondition,
                         const Eigen::Matrix<Real, Eigen::Dynamic, 1>& b, double tolerance, int most_iterations,
                         int restart = 60) {
  using VectorR = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
  using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
  KrylovResult<Real> result;
  result.x = VectorR::Zero(b.size());
  const Real target = static_cast<Real>(tolerance) * b.norm();
  VectorR residual = b;
  Real norm = b.norm();
  while (norm > target && norm > 0 && result.iterations < most_iterations) {
    static thread_local Matrix basis;  // kept: large blocks are costly to get afresh for every system
    if (basis.rows() != b.size() || basis.cols() < restart + 1) {
      basis.resize(0, 0);  // empty, should there be no memory: Eigen frees it before it asks for more
      basis.resize(b.size(), restart + 1);
    }
    Matrix hessenberg = Matrix::Zero(restart + 1, restart);
    VectorR cosine(restart), sine(restart), g = VectorR::Zero(restart + 1);
    basis.col(0) = residual / norm;
    g(0) = norm;
    int k = 0;
    for (; k < restart && result.iterations < most_iterations; ++k) {
      require_time();
      ++result.iterations;
      VectorR next = apply(precondition(basis.col(k)));
      // Classical Gram-Schmidt, twice.
      for (int pass = 0; pass < 2; ++pass) {
        const VectorR along = basis.leftCols(k + 1).transpose() * next;
        next.noalias() -= basis.leftCols(k + 1) * along;
        hessenberg.col(k).head(k + 1) += along;
      }
      const Real length = next.norm();
      hessenberg(k + 1, k) = length;
      if (length > 0) basis.col(k + 1) = next / length;
      for (int i = 0; i < k; ++i) {  // Givens rotations
        const Real upper = hessenberg(i, k), lower = hessenberg(i + 1, k);
        hessenberg(i, k) = cosine(i) * upper + sine(i) * lower;
        hessenberg(i + 1, k) = -sine(i) * upper + cosine(i) * lower;
      }
      const Real radius = std::hypot(hessenberg(k, k), hessenberg(k + 1, k));
      cosine(k) = radius > 0 ? hessenberg(k, k) / radius : Real(1);
      sine(k) = radius > 0 ? hessenberg(k + 1, k) / radius : Real(0);
      hessenberg(k, k) = radius;
      g(k + 1) = -sine(k) * g(k);
      g(k) *= cosine(k);
      if (std::abs(g(k + 1)) <= target || length == 0) {
        ++k;
        break;
      }
    }
    const VectorR y = hessenberg.topLeftCorner(k, k).template triangularView<Eigen::Upper>().solve(g.head(k));
    if (!y.allFinite()) break;
    result.x += precondition(basis.leftCols(k) * y);
    const Real before = norm;
    if (std::abs(g(k)) <= target) {  // the recurrence's own residual; the caller recomputes his
      norm = std::abs(g(k));
      break;
    }
    residual = b - apply(result.x);
    norm = residual.norm();
    if (!(norm < Real(0.999) * before)) break;  // stagnation
  }
  result.relative_residual = b.norm() > 0 ? norm / b.norm() : Real(0);
  return result;
}

}  // namespace rollres
