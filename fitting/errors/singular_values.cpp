#include "fitting/errors/singular_values.hpp"

#include <Eigen/SVD>

namespace rollres {

SingularValues::SingularValues(const Eigen::MatrixXd& a) {
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

}  // namespace rollres
