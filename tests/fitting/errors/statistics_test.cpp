#include "fitting/errors/statistics.hpp"

#include "fitting/descent/latin_hypercube.hpp"
#include "tests/catch.hpp"

using namespace rollres;

TEST_CASE("tails and quantiles agree with printed tables", "[fitting][statistics]") {
  // Abramowitz and Stegun (1964), tables 26.8 and 26.10.
  CHECK(chi_squared_tail(3.84146, 1) == Approx(0.05).epsilon(1e-4));
  CHECK(chi_squared_tail(18.3070, 10) == Approx(0.05).epsilon(1e-4));
  CHECK(two_sided_quantile(0.95, 0) == Approx(1.95996).epsilon(1e-5));
  CHECK(two_sided_quantile(0.95, 10) == Approx(2.228).epsilon(1e-3));
  CHECK(two_sided_quantile(0.95, 1) == Approx(12.706).epsilon(1e-3));
}

TEST_CASE("the runs test tells a misfit from chance", "[fitting][statistics]") {
  Eigen::VectorXd residuals(20);
  for (Eigen::Index i = 0; i < 20; ++i) residuals[i] = i < 10 ? 1 : -1;
  CHECK(runs_test(residuals) < 1e-3);
  // Ten of either sign in eleven runs: just what chance lets expect.
  residuals << 1, 1, -1, -1, 1, 1, -1, -1, 1, 1, -1, 1, 1, -1, -1, 1, -1, -1, 1, -1;
  CHECK(runs_test(residuals) > 0.5);
  CHECK(runs_test(Eigen::VectorXd::Ones(20)) == 1);
}

TEST_CASE("a Latin hypercube has one point in each part of each side", "[fitting][latin_hypercube]") {
  const Eigen::MatrixXd points = latin_hypercube(16, 3, 5);
  for (Eigen::Index d = 0; d < 3; ++d) {
    std::vector<int> counts(16, 0);
    for (const double place : points.col(d)) ++counts[static_cast<std::size_t>(16 * place)];
    CHECK(counts == std::vector<int>(16, 1));
  }
  CHECK(latin_hypercube(16, 3, 5) == points);
  CHECK(latin_hypercube(16, 3, 6) != points);
}
