#include "core/algebra/nearby_systems.hpp"

#include <cmath>

#include "tests/catch.hpp"

using namespace rollres;

namespace {

constexpr Eigen::Index size = 60;

/// Regular, and by `moved` away from that at 0.
Eigen::MatrixXd matrix_at(double moved) {
  Eigen::MatrixXd a(size, size);
  for (Eigen::Index i = 0; i < size; ++i)
    for (Eigen::Index j = 0; j < size; ++j)
      a(i, j) = (i == j ? 4 : 0) + 1 / (static_cast<double>(i - j) + 0.5) +
                moved * std::cos(static_cast<double>(1 + i * (j + 2)));
  return a;
}

Eigen::VectorXd right_side() {
  Eigen::VectorXd b(size);
  for (Eigen::Index i = 0; i < size; ++i) b(i) = std::sin(static_cast<double>(i));
  return b;
}

std::optional<Eigen::VectorXd> solved(NearbySystems& nearby, const NearbySystems::Shape& shape,
                                      const Eigen::MatrixXd& a) {
  return nearby.solve(
      shape, [&](const Eigen::VectorXd& x) { return Eigen::VectorXd(a * x); }, right_side());
}

}  // namespace

TEST_CASE("factors of one system solve those nearby to rounding", "[core][nearby_systems]") {
  NearbySystems nearby;
  const NearbySystems::Shape shape{size, 3};
  CHECK(!solved(nearby, shape, matrix_at(0)));
  nearby.factorise(shape, matrix_at(0), right_side());
  for (const double moved : {0.0, 1e-10, 1e-6, 1e-4, 1e-3}) {
    const Eigen::MatrixXd a = matrix_at(moved);
    const std::optional<Eigen::VectorXd> x = solved(nearby, shape, a);
    REQUIRE(x);
    const Eigen::VectorXd expected = SquareSystem(a).solve(right_side());
    CHECK((*x - expected).norm() < 1e-12 * expected.norm());
  }
  CHECK(nearby.factorised() == 1);
}

TEST_CASE("factors of a system far away, of another kind or of none are not taken", "[core][nearby_systems]") {
  NearbySystems nearby;
  const NearbySystems::Shape shape{size};
  nearby.factorise(shape, matrix_at(0), right_side());
  CHECK(!solved(nearby, {size, 1}, matrix_at(0)));
  CHECK(!solved(nearby, shape, matrix_at(3)));
  CHECK(!solved(nearby, shape, matrix_at(NAN)));
  CHECK(solved(nearby, shape, matrix_at(1e-6)));  // what failed has not spoilt them
  nearby.factorise(shape, Eigen::MatrixXd::Zero(size, size), right_side());
  CHECK(!solved(nearby, shape, matrix_at(0)));
}
