#include "studies/scatter/correlation.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <numbers>

#include "studies/study/sampling.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"

using namespace rollres;

TEST_CASE("correlated uniform numbers have the rank correlation of the Gaussian copula",
          "[studies][scatter][correlation]") {
  // Spearman's rank correlation is 6 / pi asin(rho / 2) (Kruskal, 1958); 4096 points of low discrepancy tell it to 1e-2
  for (const double rho : {-0.8, 0.3, 0.95}) {
    auto uniform = batched_sample(SampleMethod::sobol, 1, 4096, 2, 1);
    correlate(uniform, correlation_factor(2, {{0, 1, rho}}));
    double ranks = 0;
    for (std::size_t i = 0; i < 4096; ++i) ranks += 12 * (uniform[0][i] - 0.5) * (uniform[1][i] - 0.5) / 4096;
    CHECK(ranks == Approx(6 / std::numbers::pi * std::asin(rho / 2)).margin(1e-2));
    for (auto& column : uniform) {  // each by itself stays uniform
      std::sort(column.begin(), column.end());
      for (std::size_t i = 0; i < 4096; ++i)
        CHECK(column[i] == Approx((static_cast<double>(i) + 0.5) / 4096).margin(0.02));
    }
  }
}

TEST_CASE("without pairs nothing is correlated", "[studies][scatter][correlation]") {
  const auto independent = batched_sample(SampleMethod::sobol, 2, 16, 3, 1);
  auto same = independent;
  correlate(same, correlation_factor(3, {}));
  CHECK(same == independent);
}

TEST_CASE("the factor times its transpose is the matrix of the correlations", "[studies][scatter][correlation]") {
  const Eigen::MatrixXd factor = correlation_factor(3, {{0, 1, 0.5}, {2, 0, -0.2}});
  Eigen::MatrixXd matrix(3, 3);
  matrix << 1, 0.5, -0.2, 0.5, 1, 0, -0.2, 0, 1;
  CHECK((factor * factor.transpose() - matrix).norm() < 1e-14);
}

TEST_CASE("correlations that contradict each other are refused", "[studies][scatter][correlation]") {
  // eigenvalues of 1 with 0.9, 0.9, -0.9 beside its diagonal: 1.9, 1.9, -0.8
  CHECK(message_of([] {
          correlation_factor(3, {{0, 1, 0.9}, {1, 2, 0.9}, {0, 2, -0.9}});
        }) ==
        "the correlations contradict each other: the smallest eigenvalue of their matrix is -0.8, it must be positive");
}
