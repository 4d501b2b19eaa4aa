#include "core/numerics/finite_difference.hpp"

#include <cmath>

#include "tests/catch.hpp"
#include "tests/core/scattered.hpp"

using namespace rollres;

namespace {

template <class Function>
NoiseEstimate estimated(Function function, double spacing, int size, double unevenness = 0) {
  std::vector<double> points, values;
  for (int i = 0; i < size; ++i) {
    points.push_back((i - size / 2 + unevenness * std::sin(2.0 * i)) * spacing);
    values.push_back(function(points.back()));
  }
  return estimate_noise(points, values);
}

NoiseEstimate of_values(const std::vector<double>& values) {
  return estimated([&, i = std::size_t{0}](double) mutable { return values[i++]; }, 1, static_cast<int>(values.size()));
}

double smooth(double x) { return std::exp(std::sin(2 * x) + 0.3 * x); }

}  // namespace

TEST_CASE("the noise of a function with noise of known size is found within a factor of 3", "[core][noise_estimate]") {
  for (const double unevenness : {0.0, 0.4})
    for (const double deviation : {1e-12, 1e-8, 1e-4}) {
      int close = 0;
      for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const NoiseEstimate estimate =
            estimated([&](double x) { return smooth(x) + deviation * scatter(x, seed); }, 1e-5, 7, unevenness);
        if (estimate.noise > deviation / 3 && estimate.noise < deviation * 3) ++close;
      }
      CAPTURE(unevenness, deviation);
      CHECK(close >= 90);  // six differences are a small sample: the rest is its scatter
    }
}

TEST_CASE("a smooth function far apart is told from noise", "[core][noise_estimate]") {
  const NoiseEstimate estimate = estimated(smooth, 0.05, 9, 0.3);
  CHECK(estimate.outcome == NoiseOutcome::spacing_too_large);
  CHECK(std::isnan(estimate.noise));
  CHECK(estimate.levels.size() == 8);
}

TEST_CASE("a constant and a staircase show no noise at a spacing that is too small", "[core][noise_estimate]") {
  CHECK(of_values(std::vector<double>(7, 3.0)).outcome == NoiseOutcome::spacing_too_small);
  CHECK(of_values({1, 1, 1, 2, 2, 2, 2}).outcome == NoiseOutcome::spacing_too_small);
}

TEST_CASE("alternating values are noise of their own size", "[core][noise_estimate]") {
  // the k-th differences of +-1 are +-2^k and their weights the binomial coefficients, so that
  // sigma_k² = 4^k (k!)² / (2k)!, which grows slowly from 2
  const NoiseEstimate estimate = of_values({1, -1, 1, -1, 1, -1, 1});
  CHECK(estimate.outcome == NoiseOutcome::found);
  CHECK(estimate.levels[0] == Approx(std::sqrt(2.0)));
  CHECK(estimate.levels[1] == Approx(std::sqrt(16.0 / 6)));
  CHECK(estimate.noise == Approx(std::sqrt(64 / 20.0)));
}
