#pragma once

#include <Eigen/Core>

namespace rollres {

/// The x >= 0 with the least |A x - b| (Lawson and Hanson 1974, Solving Least Squares Problems, chapter 23).
Eigen::VectorXd nonnegative_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

}  // namespace rollres
