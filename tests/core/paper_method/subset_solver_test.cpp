#include "core/paper_method/subset_solver.hpp"

#include <random>

#include "tests/catch.hpp"

using namespace rollres;

TEST_CASE("a decomposition reused over changing index sets gives the solutions of fresh ones",
          "[core][subset_solver]") {
  const int size = 60;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1, 1);
  const Eigen::MatrixXd matrix = Eigen::MatrixXd::NullaryExpr(size, size, [&] { return number(random); }) +
                                 8 * Eigen::MatrixXd::Identity(size, size);
  SubsetSolver solver(
      size, [&](int row, int column) { return matrix(row, column); }, 0.2);
  std::vector<char> in(size, 0);
  for (int k = 10; k < 50; ++k) in[k] = 1;
  for (int step = 0; step < 40; ++step) {
    std::vector<int> set;
    for (int k = 0; k < size; ++k)
      if (in[k]) set.push_back(k);
    const Eigen::VectorXd rhs =
        Eigen::VectorXd::NullaryExpr(static_cast<Eigen::Index>(set.size()), [&] { return number(random); });
    const Eigen::VectorXd reused = solver.solve(set, rhs);
    // The matrix is diagonally dominant enough for both routes to keep 13 digits; the tolerance leaves a factor of 100.
    CHECK((matrix(set, set) * reused - rhs).norm() < 1e-11 * rhs.norm());
    const int flip = std::uniform_int_distribution<int>(0, size - 1)(random);
    in[flip] = !in[flip];
  }
  CHECK(solver.solutions() == 40);
  CHECK(solver.decompositions() < 10);
}
