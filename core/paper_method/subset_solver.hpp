#pragma once

/// Linear systems M(S,S) x = f on changing index sets S of one matrix M, with one decomposition reused.
///
/// Let B be the set that was factorised, A the indices of S that are not in B and D those of B that are not in S. Then
/// x(S) follows from the bordered system
///     | M(B,B)  M(B,A)  E_D | | x_B |   | f_B |
///     | M(A,B)  M(A,A)   0  | | x_A | = | f_A |
///     | E_D^T     0      0  | | r_D |   |  0  |
/// whose Schur complement is as small as the change. It costs 2 n^2 operations per index that changed, against
/// 2 n^3 / 3 for a new decomposition, which is made when the change is larger than a fraction of B.

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "core/algebra/dense_algebra.hpp"

namespace rollres {

class SubsetSolver {
 public:
  /// Element (row, column) of M.
  using Element = std::function<double(int row, int column)>;

  /// @param size number of rows of M   @param largest_change fraction of the base set that may change before a new
  /// decomposition is made; 0: a new one for every set
  SubsetSolver(int size, Element element, double largest_change = 0.1);

  /// x over `set` for the right-hand side `rhs` over `set`. A singular system gives numbers that are not finite.
  Eigen::VectorXd solve(const std::vector<int>& set, const Eigen::VectorXd& rhs);

  int decompositions() const { return decompositions_; }
  int solutions() const { return solutions_; }

 private:
  void factorise(const std::vector<int>& set);
  void prepare(const std::vector<int>& set);
  int border_of(int index, bool added);

  Element element_;
  double largest_change_;
  int decompositions_ = 0, solutions_ = 0;

  std::vector<int> base_, place_;  // B, and the place of each index in it (-1: not there)
  SquareSystem decomposition_;

  /// One bordered index: its column of M(B,B)^-1 [M(B,A) E_D] and its row of [M(A,B); E_D^T].
  Eigen::MatrixXd columns_, rows_;
  std::vector<int> bordered_, border_place_;
  int borders_ = 0;

  std::vector<int> set_, added_, removed_, active_;  // the set that is prepared
  SquareSystem schur_;
};

}  // namespace rollres
