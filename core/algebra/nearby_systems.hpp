#pragma once

/// Dense systems of equations one after another, each much like one before: the factors of that one, as preconditioner,
/// and its solution, as start, save the cube of operations. Solutions are as exact as those by factors of their own.

#include <Eigen/Core>

#include <functional>
#include <optional>
#include <vector>

#include "core/algebra/dense_algebra.hpp"

namespace rollres {

class NearbySystems {
 public:
  using Shape = std::vector<Eigen::Index>;  ///< what systems must share to be alike: the meaning of their unknowns
  using Apply = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

  /// Solves A x = b by the factors of a former matrix of this shape.
  /// @param apply x to A x
  /// @return nothing if there are no such factors, or they are too far from A
  std::optional<Eigen::VectorXd> solve(const Shape& shape, const Apply& apply, const Eigen::VectorXd& right_side);

  /// Solves by factors of the matrix, and keeps them.
  Eigen::VectorXd factorise(const Shape& shape, const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right_side);

  /// How often it had to.
  int factorised() const { return factorised_; }

 private:
  Shape shape_;
  SquareSystem factors_;
  Eigen::VectorXd solution_;
  double rounded_ = 0;  // residual that the factors left
  int factorised_ = 0;
};

}  // namespace rollres
