#include "core/algebra/dense_algebra.hpp"

#include <cmath>

#include "tests/catch.hpp"

// Covers dense_products, too.

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

TEST_CASE("A positive system is solved and inverted by its root, and another is told", "[numerics]") {
  const Eigen::MatrixXd a = dependent_columns(12, 5).leftCols(4);
  Eigen::MatrixXd matrix = a.transpose() * a;
  matrix.diagonal().array() += 0.1;
  const PositiveSystem system(matrix);
  CHECK(system.definite());
  CHECK((system.lower() * system.lower().transpose()).isApprox(matrix, 1e-14));
  CHECK((matrix * system.inverse()).isIdentity(1e-12));
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(4, -1, 2);
  CHECK((matrix * system.solve(b)).isApprox(b, 1e-12));
  // Principal values 2 and 8, turned.
  Eigen::MatrixXd turned = Eigen::Vector2d(2, 8).asDiagonal();
  const Eigen::Matrix2d turn = (Eigen::Matrix2d() << 0.6, -0.8, 0.8, 0.6).finished();
  turned = turn * turned * turn.transpose();
  CHECK(PositiveSystem(turned).log_root_determinant() == Approx(std::log(4.0)));
  turned(0, 0) = -1;
  CHECK_FALSE(PositiveSystem(turned).definite());
}

TEST_CASE("An overdetermined system leaves nothing along its columns, by its triangle either", "[numerics]") {
  const Eigen::MatrixXd a = dependent_columns(12, 6).leftCols(5);
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(12, -1, 2);
  const OverdeterminedSystem system(a);
  const Eigen::VectorXd x = system.solve(b);
  for (Eigen::Index j = 0; j < a.cols(); ++j)
    CHECK(std::abs(a.col(j).dot(b - a * x)) < 1e-12 * a.col(j).norm() * b.norm());
  const Eigen::MatrixXd triangle = system.triangle();
  CHECK((triangle.transpose() * triangle).isApprox(a.transpose() * a, 1e-13));
  CHECK((triangle * inverse_of_upper(triangle)).isIdentity(1e-12));
  const Eigen::MatrixXd wide = a.topRows(3);
  const Eigen::VectorXd some = OverdeterminedSystem(wide).solve(b.head(3));
  CHECK((wide * some).isApprox(b.head(3), 1e-10));
  CHECK(some.tail(2).isZero(0));
}

TEST_CASE("Products of matrices and vectors are sums over their elements, in either order of storage", "[numerics]") {
  // Larger than a panel of the kernels and no multiple of a register.
  const Eigen::MatrixXd a = dependent_columns(83, 57), b = dependent_columns(57, 61);
  const auto sum = [&](Eigen::Index i, Eigen::Index j) {
    long double all = 0;
    for (Eigen::Index k = 0; k < a.cols(); ++k) all += static_cast<long double>(a(i, k)) * b(k, j);
    return static_cast<double>(all);
  };
  const Eigen::MatrixXd expected = Eigen::MatrixXd::NullaryExpr(a.rows(), b.cols(), sum);
  const Eigen::MatrixXd at = a.transpose(), bt = b.transpose();
  for (const Eigen::MatrixXd& product :
       {Eigen::MatrixXd(a * b), Eigen::MatrixXd(at.transpose() * b), Eigen::MatrixXd(a * bt.transpose()),
        Eigen::MatrixXd(at.transpose() * bt.transpose())})
    CHECK((product - expected).cwiseAbs().maxCoeff() < 1e-13 * expected.cwiseAbs().maxCoeff());
  for (const Eigen::VectorXd& product : {Eigen::VectorXd(a * b.col(3)), Eigen::VectorXd(at.transpose() * b.col(3))})
    CHECK((product - expected.col(3)).cwiseAbs().maxCoeff() < 1e-13 * expected.cwiseAbs().maxCoeff());
}
