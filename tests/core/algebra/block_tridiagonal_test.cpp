#include "core/algebra/block_tridiagonal.hpp"

#include <cmath>

#include "tests/catch.hpp"

using namespace rollres;

TEST_CASE("a row of coupled blocks is solved as the full matrix is", "[core][numerics]") {
  constexpr Eigen::Index blocks = 5, size = 6, last = 4, shared = 3;
  BlockTridiagonal rows(blocks, size, last, shared);
  const Eigen::Index unknowns = rows.unknowns();
  REQUIRE(unknowns == 28);
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(unknowns, unknowns);
  for (Eigen::Index i = 0; i < unknowns; ++i)
    for (Eigen::Index j = 0; j < unknowns; ++j) {
      const Eigen::Index a = i / size, b = j / size;
      const bool coupled = a == b || (a == b + 1 && i % size < shared) || (b == a + 1 && j % size < shared);
      if (!coupled) continue;
      full(i, j) = std::sin(1.0 + 3.7 * static_cast<double>(i) + 1.3 * static_cast<double>(j * j));
      if (i == j) full(i, j) = 0;  // so that pivots are needed
      rows.add(i, j, 0.25 * full(i, j));
      rows.add(i, j, 0.75 * full(i, j));
    }
  Eigen::VectorXd x(unknowns);
  for (Eigen::Index i = 0; i < unknowns; ++i) x(i) = std::cos(static_cast<double>(i));
  const Eigen::VectorXd right_side = full * x;
  rows.factorise();
  CHECK((rows.solve(right_side) - x).norm() < 1e-10 * x.norm());  // rounding times the condition number
}
