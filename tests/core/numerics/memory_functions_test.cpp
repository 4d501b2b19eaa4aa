#include "core/numerics/memory_functions.hpp"

#include <cmath>

#include "core/numerics/quadrature.hpp"
#include "tests/catch.hpp"

using namespace rollres;

TEST_CASE("scaled Bessel functions are the standard library's where that does not overflow",
          "[core][memory_functions]") {
  for (const double x : {1e-6, 0.1, 1.0, 20.0, 99.0, 300.0}) {
    const Eigen::VectorXd i = scaled_bessel_i(x, 12);
    // The library's own errors grow with x.
    for (int n = 0; n < 12; ++n) CHECK(i(n) == Approx(std::exp(-x) * std::cyl_bessel_i(n, x)).epsilon(1e-11).margin(0));
    const ScaledBesselK k = scaled_bessel_k(x);
    CHECK(k.order_0 == Approx(std::exp(x) * std::cyl_bessel_k(0, x)).epsilon(1e-12));
    CHECK(k.order_1 == Approx(std::exp(x) * std::cyl_bessel_k(1, x)).epsilon(1e-12));
  }
}

TEST_CASE("scaled Bessel functions of huge arguments sum to one", "[core][memory_functions]") {
  for (const double x : {1e3, 1e4, 1e5}) {
    const Eigen::VectorXd i = scaled_bessel_i(x, static_cast<int>(10 * std::sqrt(x)));
    CHECK(i(0) + 2 * i.tail(i.size() - 1).sum() == Approx(1).epsilon(1e-12));
  }
  // Upwards and downwards give the same.
  CHECK(scaled_bessel_i(1e4, 20)(19) == Approx(scaled_bessel_i(1e4, 500)(19)).epsilon(1e-12));
}

TEST_CASE("the memory beyond an edge is its integral", "[core][memory_functions]") {
  const QuadratureRule rule = gauss_legendre(20);
  for (const double x : {1e-4, 0.3, 4.0, 150.0, 1e4}) {
    const Eigen::VectorXd b = edge_memory(x, 30, scaled_bessel_k(x));
    CHECK(b(0) == 1);
    for (const int n : {1, 2, 7, 29}) {
      const double last = std::acosh(1 + 40 / x);
      const int panels = 8 + static_cast<int>(last * n);
      double sum = 0;
      for (int panel = 0; panel < panels; ++panel)
        for (std::size_t q = 0; q < rule.nodes.size(); ++q) {
          const double h = last * (panel + rule.nodes[q]) / panels;
          sum += last / panels * rule.weights[q] * x * std::exp(-2 * x * std::pow(std::sinh(h / 2), 2) - n * h) *
                 std::sinh(h);
        }
      CAPTURE(x, n);
      CHECK(b(n) == Approx(sum).epsilon(1e-11));
    }
  }
}

TEST_CASE("the scaled exponential integrals are the standard library's", "[core][memory_functions]") {
  for (double x = 1e-8; x < 600; x *= 1.07) {
    CAPTURE(x);
    if (x < 90)  // beyond it the library's has three digits
      CHECK(scaled_exponential_integral(x) == Approx(-std::exp(x) * std::expint(-x)).epsilon(1e-13));
    CHECK(scaled_growing_integral(x) == Approx(std::exp(-x) * std::expint(x)).epsilon(1e-13).margin(1e-15));
  }
  CHECK(scaled_exponential_integral(1023.999) == Approx(scaled_exponential_integral(1024.001)).epsilon(3e-6));
  CHECK(scaled_exponential_integral(1e6) == Approx(1e-6 * (1 - 1e-6)).epsilon(1e-11));
}

TEST_CASE("the growing exponential integral and those of cosine and sine have their tabulated values",
          "[core][memory_functions]") {
  CHECK(scaled_growing_integral(1.0) == Approx(std::exp(-1.0) * 1.8951178163559368).epsilon(1e-13));
  CHECK(scaled_growing_integral(39.999) == Approx(scaled_growing_integral(40.001)).epsilon(1e-4));
  CHECK(scaled_growing_integral(1e4) == Approx(1e-4 * (1 + 1e-4 + 2e-8)).epsilon(1e-11));
  // Abramowitz and Stegun, tables 5.1 and 5.3.
  CHECK(trigonometric_integrals(1).cosine == Approx(0.3374039229009681).epsilon(1e-13));
  CHECK(trigonometric_integrals(1).sine == Approx(0.9460830703671830).epsilon(1e-13));
  CHECK(trigonometric_integrals(10).cosine == Approx(-0.0454564330044554).epsilon(1e-11));
  CHECK(trigonometric_integrals(10).sine == Approx(1.6583475942188740).epsilon(1e-13));
}
