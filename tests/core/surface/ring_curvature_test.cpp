#include "core/surface/ring_curvature.hpp"

#include <cmath>

#include "core/numerics/quadrature.hpp"
#include "core/surface/ring_compliance.hpp"
#include "tests/catch.hpp"

using namespace rollres;

namespace {

MediumLayer cover(double poisson_ratio) {
  return {0.3, poisson_ratio, 0, {.instantaneous = 0.4, .terms = {{0.5, 0.05}, {0.3, 2.0}}}, 1.3};
}

/// Re int_0^inf f(k) e^{ikx} dk by panels; f falls off like a power, which `slowly` takes out: a/(1 + (k/c)^2).
template <class Transform>
double transformed(const Transform& f, double x) {
  std::complex<double> sum = 0;
  const QuadratureRule& gauss = gauss_rule(16);
  const double width = 0.5;
  for (double from = 0; from < 4000; from += width)
    for (std::size_t q = 0; q < gauss.nodes.size(); ++q) {
      const double k = from + width * gauss.nodes[q];
      sum += width * gauss.weights[q] * f(k) * std::exp(std::complex<double>(0, k * x));
    }
  return sum.real();
}

}  // namespace

TEST_CASE("slopes of a ring's curvature are the transform of what it adds, forwards and backwards",
          "[core][ring_curvature]") {
  const auto of = GENERATE(RingCurvature::Of::pressure, RingCurvature::Of::shear);
  const std::complex<double> factor = of == RingCurvature::Of::pressure ? std::complex<double>(0, 1) : -1;
  for (const double poisson_ratio : {0.3, 0.5})
    for (const double speed : {1.0, -1.0}) {
      const RingCurvature curvature(cover(poisson_ratio), speed, of, speed < 0);
      for (const double x : {-3.0, -0.4, 0.2, 1.5}) {
        CAPTURE(poisson_ratio, speed, x);
        const double slope = transformed([&](double k) { return factor * curvature(k) / M_PI; }, x);
        CHECK(curvature.slope(x) == Approx(slope).margin(2e-4));  // the integral ends at k = 4000, where 1/k is left
        const double step = 1e-5;
        CHECK((curvature.displacement(x + step) - curvature.displacement(x - step)) / (2 * step) ==
              Approx(curvature.slope(x)).margin(1e-8));
      }
      // Under shear a transform without a value at k = 0 but that of the steps is as far from 0 ahead as behind.
      if (of == RingCurvature::Of::shear)
        CHECK(curvature.displacement(1e4) == Approx(-curvature.displacement(-1e4)).epsilon(1e-3));
    }
}

TEST_CASE("a ring's curvature over a spectrum, and seen through a memory, are quotient and product",
          "[core][ring_curvature]") {
  const auto of = GENERATE(RingCurvature::Of::pressure, RingCurvature::Of::shear);
  CreepSpectrum deep = cover(0.3).material;
  deep.instantaneous += 0.2;
  deep.terms.insert(deep.terms.begin() + 1, {0.4, 0.3});
  const double speed = 0.8, length = 0.7;
  const RingCurvature curvature(cover(0.3), speed, of, true), over = curvature.over(deep),
                                                              seen = over.remembered({length}).front();
  for (const double k : {0.01, 0.7, 5.0, 300.0}) {
    const std::complex<double> quotient = curvature(k) / deep(-k * speed);
    CHECK(std::abs(over(k) - quotient) < 1e-12 * std::abs(quotient));
    const std::complex<double> product = quotient / std::complex<double>(1, -k * length);
    CHECK(std::abs(seen(k) - product) < 1e-12 * std::abs(quotient));
  }
}

TEST_CASE("a ring without memory has its logarithm alone at the force", "[core][ring_curvature]") {
  MediumLayer elastic = cover(0.5);
  elastic.material.terms.clear();
  const RingCurvature curvature(elastic, 1, RingCurvature::Of::pressure, false);
  const LogarithmicSlope logarithmic = curvature.logarithmic_slope(0.01);
  const auto rest = [&](double x) { return curvature.slope(x) - logarithmic(x) * std::log(std::abs(x)); };
  // What is left is smooth: its differences at half the distance are half of it.
  CHECK(rest(1e-3) / rest(5e-4) == Approx(2).epsilon(1e-6));
  // A memory as long as the distances has an even part as well, and so has shear.
  for (const auto of : {RingCurvature::Of::pressure, RingCurvature::Of::shear}) {
    const RingCurvature slow(cover(0.5), 1, of, true);
    const LogarithmicSlope of_slow = slow.logarithmic_slope(0.01);
    const auto second = [&](double x) {
      const auto value = [&](double at) { return slow.slope(at) - of_slow(at) * std::log(std::abs(at)); };
      return value(x) + value(-x) - 2 * slow.slope(0);
    };
    CHECK(second(2e-3) / second(1e-3) == Approx(4).epsilon(1e-3));
  }
  // Beyond the series' end both routes agree.
  CHECK(curvature.slope(1.3 * (1 + 1e-9)) == Approx(curvature.slope(1.3 * (1 - 1e-9))).epsilon(1e-7));
}

TEST_CASE("short waves on a ring are those of the half-space and its curvature", "[core][ring_curvature]") {
  for (const double poisson_ratio : {0.2, 0.5}) {
    MediumLayer ring = cover(poisson_ratio);
    const RingCurvature pressed(ring, 0.7, RingCurvature::Of::pressure, false);
    const RingCurvature sheared(ring, 0.7, RingCurvature::Of::shear, false);
    ring.thickness = 0.9;  // the core is not felt: e^{-2.3 n}
    for (const double n : {12.0, 24.0}) {
      const double k = n / ring.radius;
      const std::vector<std::complex<double>> moduli = moduli_at({ring}, -0.7 * k);
      const SurfaceCompliance all = surface_compliance({ring}, moduli, k, 0.7);
      const std::complex<double> c = k * all.normal, deep = half_space_compliance(ring, moduli.front(), 0.7).normal;
      CHECK(std::abs(c - deep - pressed(k)) < (500 * std::pow(n, -9) + 1e-12) * std::abs(deep));
      CHECK(std::abs(c - deep) > 0.5 * std::pow(n, -2) * std::abs(deep));
      CHECK(std::abs(k * all.hoop - sheared(k)) < (500 * std::pow(n, -8) + 1e-12) * std::abs(deep));
      CHECK(std::abs(k * all.hoop) > 0.5 / n * std::abs(deep));
    }
  }
}
