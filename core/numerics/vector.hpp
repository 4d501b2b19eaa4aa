#pragma once

#include <Eigen/Core>

namespace rollres {

/// One number for each node of a grid, or for each unknown.
using Vector = Eigen::VectorXd;

}  // namespace rollres
