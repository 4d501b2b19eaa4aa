#include "core/algebra/dense_algebra.hpp"

#include "tests/catch.hpp"

using namespace rollres;

TEST_CASE("non-negative least squares leave out what would need a negative factor", "[core][numerics]") {
  const Eigen::MatrixXd a{{1, 1}, {0, 1}};
  CHECK(nonnegative_least_squares(Eigen::MatrixXd(2, 0), Eigen::Vector2d(1, 2)).size() == 0);
  CHECK(nonnegative_least_squares(a, Eigen::Vector2d(3, 2)).isApprox(Eigen::Vector2d(1, 2)));
  const Eigen::VectorXd one = nonnegative_least_squares(a, Eigen::Vector2d(1, 2));
  CHECK(one[0] == 0);
  CHECK(one[1] == Approx(1.5));
  CHECK(nonnegative_least_squares(a.leftCols(1), Eigen::Vector2d(-1, 2))[0] == 0);
}
