#include "core/numerics/finite_difference.hpp"

#include <cmath>

#include "tests/catch.hpp"

using namespace rollres;

TEST_CASE("the weights of equal steps are the textbook's", "[core][finite_difference]") {
  const auto check = [](const std::vector<double>& offsets, const std::vector<double>& expected) {
    const std::vector<double> weights = first_derivative_weights(offsets);
    REQUIRE(weights.size() == expected.size());
    for (std::size_t i = 0; i < weights.size(); ++i) CHECK(weights[i] == Approx(expected[i]).margin(1e-15));
  };
  check({-1, 1}, {-0.5, 0.5});
  check({0, 2, 4}, {-0.75, 1, -0.25});
  check({-2, -1, 1, 2}, {1 / 12.0, -8 / 12.0, 8 / 12.0, -1 / 12.0});
  check({0, -1, -2, -3, -4}, {25 / 12.0, -4, 3, -4 / 3.0, 0.25});
}

TEST_CASE("a formula of n points differentiates polynomials of degree n - 1 exactly, wherever its points lie",
          "[core][finite_difference]") {
  const std::vector<double> offsets{-0.3, 0.1, 0.25, 0.7};
  const std::vector<double> weights = first_derivative_weights(offsets);
  for (int degree = 0; degree < 4; ++degree) {
    double sum = 0;
    for (std::size_t i = 0; i < offsets.size(); ++i) sum += weights[i] * std::pow(offsets[i], degree);
    CHECK(sum == Approx(degree == 1 ? 1.0 : 0.0).margin(1e-14));
  }
}

TEST_CASE("the divided differences of a power are those of Newton, wherever the points lie",
          "[core][finite_difference]") {
  const std::vector<double> points{-1, -0.4, 0.1, 0.5, 1.2, 1.5};
  std::vector<double> values;
  for (const double point : points) values.push_back(7 + 3 * std::pow(point, 4));
  for (const double fourth : divided_differences(points, values, 4).values) CHECK(fourth == Approx(3).epsilon(1e-12));
  CHECK(divided_differences(points, values, 5).values[0] == Approx(0).margin(1e-12));
  const double slope = (values[1] - values[0]) / (points[1] - points[0]);
  CHECK(divided_differences(points, values, 1).values[0] == Approx(slope).epsilon(1e-14));
}

TEST_CASE("the norms of equally spaced divided differences are binomial", "[core][finite_difference]") {
  const std::vector<double> points{0, 1, 2, 3, 4, 5, 6}, values(7, 0.0);
  CHECK(divided_differences(points, values, 1).norms[5] == Approx(std::sqrt(2.0)));
  CHECK(divided_differences(points, values, 6).norms[0] == Approx(std::sqrt(924.0) / 720));  // 12 over 6, 6!
}
