#pragma once

/// Systems of equations whose unknowns stand in a row of blocks, each coupled to its neighbours alone.

#include <Eigen/Core>
#include <vector>

#include "core/algebra/dense_algebra.hpp"

namespace rollres {

/// LU decomposition block by block, with pivots inside each block:
///   D'_0 = D_0,  D'_k = D_k - L_k D'_(k-1)^-1 U_(k-1).
/// L_k couples the first `shared` unknowns of block k to all of block k - 1, U_(k-1) all of block k - 1 to these.
class BlockTridiagonal {
 public:
  /// @param last  unknowns of the last block, at least `shared`; all others have `size`
  BlockTridiagonal(Eigen::Index blocks, Eigen::Index size, Eigen::Index last, Eigen::Index shared);

  void set_zero();
  /// Adds to the entry of two unknowns, counted through all blocks, of the same or of neighbouring ones.
  void add(Eigen::Index row, Eigen::Index column, double value) { entry(row, column) += value; }
  double& entry(Eigen::Index row, Eigen::Index column);

  /// After this the entries are gone.
  void factorise();
  Eigen::VectorXd solve(const Eigen::VectorXd& right_side) const;

  Eigen::Index unknowns() const { return unknowns_; }

 private:
  Eigen::Index size_, shared_, unknowns_;
  std::vector<Eigen::MatrixXd> diagonal_, lower_, upper_;
  std::vector<SquareSystem> decomposition_;
};

}  // namespace rollres
