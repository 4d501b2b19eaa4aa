#include "core/numerics/chebyshev.hpp"

#include <array>
#include <cmath>

#include "core/numerics/quadrature.hpp"
#include "tests/catch.hpp"

using namespace rollres;

namespace {

/// int sqrt(1 - s^2) U_n(s) h(s) ds by s = cos(angle) and Gauss's rule.
template <class Function>
double against_density(int n, const Function& h) {
  const QuadratureRule& rule = gauss_rule(60);
  double sum = 0;
  for (std::size_t q = 0; q < rule.nodes.size(); ++q) {
    const double angle = M_PI * rule.nodes[q];
    sum += M_PI * rule.weights[q] * std::sin(angle) * std::sin((n + 1) * angle) * h(std::cos(angle));
  }
  return sum;
}

}  // namespace

TEST_CASE("a smooth function is integrated against Chebyshev's densities by the rule's nodes", "[core][chebyshev]") {
  const ChebyshevRule& rule = chebyshev_rule(16);
  const auto h = [](double s) { return std::exp(0.7 * s); };
  for (int n = 0; n < 5; ++n) {
    double sum = 0;
    for (int k = 0; k < rule.order; ++k) sum += rule.densities(k, n) * h(rule.nodes(k));
    CHECK(sum == Approx(against_density(n, h)).epsilon(1e-13).margin(1e-14));  // rounding of terms of size 1
  }
}

TEST_CASE("the field of a density beyond its ends is its Cauchy integral", "[core][chebyshev]") {
  for (const double t : {-3.0, -1.4, 1.3, 2.5}) {
    const Eigen::VectorXd images = chebyshev_images(t, 6);
    for (int n = 0; n < 5; ++n)
      CHECK(M_PI * images(n + 1) == Approx(against_density(n, [&](double s) { return 1 / (t - s); })).margin(1e-13));
  }
  const Eigen::VectorXd inside = chebyshev_images(0.3, 6);
  for (int n = 0; n < 6; ++n) CHECK(inside(n) == Approx(std::cos(n * std::acos(0.3))).margin(1e-15));
}

TEST_CASE("Clenshaw's sum is the sum of the polynomials", "[core][chebyshev]") {
  using Value = Eigen::Array<double, 2, 1>;
  const std::array<Value, 4> c{Value(1, 2), Value(0.5, -3), Value(-0.25, 0), Value(2, 0.125)};
  for (const double t : {-1.0, -0.2, 0.9}) {
    Value sum = Value::Zero();
    for (std::size_t k = 0; k < c.size(); ++k) sum += c[k] * std::cos(static_cast<double>(k) * std::acos(t));
    CHECK((chebyshev_sum(std::span<const Value>(c), t) - sum).abs().maxCoeff() < 1e-14);
  }
}

TEST_CASE("a Chebyshev table returns its functions on every panel", "[core][chebyshev]") {
  const ChebyshevTable<2> table({0, 1, 2, 3.5, 5}, 12,
                                [](double x) { return Eigen::Array2d(std::exp(-x), x * x * x); });
  for (double x = 0; x <= 5; x += 0.0371) {
    CHECK(std::abs(table(x)(0) - std::exp(-x)) < 1e-13);  // 2 (width/4)^13/13! of a panel of 1.5
    CHECK(table(x)(1) == Approx(x * x * x).margin(1e-12));
  }
}
