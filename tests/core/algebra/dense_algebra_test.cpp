#include "core/algebra/dense_algebra.hpp"

#include <cmath>

#include "tests/catch.hpp"

using namespace rollres;

namespace {

/// Columns of scales 1 to 1e-6, of which the last is the sum of the first two.
Eigen::MatrixXd dependent_columns(Eigen::Index rows, Eigen::Index columns) {
  Eigen::MatrixXd a(rows, columns);
  for (Eigen::Index i = 0; i < rows; ++i)
    for (Eigen::Index j = 0; j < columns; ++j)
      a(i, j) = std::cos(static_cast<double>(1 + i * (j + 2))) * std::pow(10, -6.0 * static_cast<double>(j) / 6);
  a.col(columns - 1) = a.col(0) + a.col(1);
  return a;
}

}  // namespace

TEST_CASE("Singular values give their matrix back, tall, wide or with dependent columns", "[numerics]") {
  const Eigen::MatrixXd tall = dependent_columns(12, 6), wide = tall.transpose();
  for (const Eigen::MatrixXd& a : {tall, wide}) {
    const SingularValues svd(a);
    CHECK((svd.u * svd.values.asDiagonal() * svd.v.transpose()).isApprox(a, 1e-14));
    CHECK(svd.values(4) > 1e-6);
    CHECK(svd.values(5) < 1e-15 * svd.values(0));
    const Eigen::MatrixXd inverse = pseudo_inverse(a, 1e-12);
    CHECK((a * inverse * a).isApprox(a, 1e-13));
    CHECK((inverse * a * inverse).isApprox(inverse, 1e-9));
  }
}

TEST_CASE("Least squares leave nothing along any column, with dependent columns too", "[numerics]") {
  const Eigen::MatrixXd a = dependent_columns(12, 6);
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(12, -1, 2);
  const Eigen::VectorXd by_columns = least_squares(a, b), shortest = SingularValues(a).least_squares(b);
  for (const Eigen::VectorXd& x : {by_columns, shortest})
    for (Eigen::Index j = 0; j < a.cols(); ++j)
      CHECK(std::abs(a.col(j).dot(b - a * x)) < 1e-12 * a.col(j).norm() * b.norm());
  CHECK(shortest.norm() <= by_columns.norm() * (1 + 1e-12));
}
