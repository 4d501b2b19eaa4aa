#include "studies/scatter/scatter_statistics.hpp"

#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "studies/scatter/correlation.hpp"
#include "studies/scatter/distribution.hpp"
#include "studies/study/sampling.hpp"
#include "tests/catch.hpp"

using namespace rollres;

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
const std::vector<double> tenths{0.1, 0.5, 0.9};
const Distribution modulus{DistributionKind::normal, {3e6, 3e5}}, time_{DistributionKind::lognormal, {0.25, 0.2}};

/// Values of a function of two inputs at scrambled points of Sobol', batch by batch.
template <class Function>
ScatterBatches scattered(std::size_t batches, std::size_t each, std::uint64_t seed, double correlation,
                         const Distribution& first, const Distribution& second, Function function) {
  auto uniform = batched_sample(SampleMethod::sobol, batches, each, 2, seed);
  if (correlation != 0) correlate(uniform, correlation_factor(2, {{0, 1, correlation}}));
  ScatterBatches values(batches);
  for (std::size_t i = 0; i < batches * each; ++i)
    values[i / each].push_back(function(quantile(first, uniform[0][i]), quantile(second, uniform[1][i])));
  return values;
}

/// How many of the intervals hold what they should.
struct Cover {
  int held = 0, all = 0;
  void count(const ScatterEstimate& estimate, double exact) {
    ++all;
    held += std::abs(estimate.value - exact) <= estimate.error ? 1 : 0;
  }
  double share() const { return static_cast<double>(held) / all; }
};

}  // namespace

TEST_CASE("the errors of a linear function of correlated normal numbers are honest", "[studies][scatter][statistics]") {
  // y = 2 a - 3 b, deviations 1 and 2, correlation 0.5: variance 4 + 36 - 12 = 28
  const Distribution a{DistributionKind::normal, {10, 1}}, b{DistributionKind::normal, {4, 2}};
  const double mean = 8, deviation = std::sqrt(28.0), z = 1.2815515655446004;
  Cover of_mean, of_deviation, of_tails, of_median;
  double largest = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const auto values = scattered(8, 64, seed, 0.5, a, b, [](double x, double y) { return 2 * x - 3 * y; });
    const ScatterStatistics found = scatter_statistics(values, tenths);
    of_mean.count(found.mean, mean);
    of_deviation.count(found.deviation, deviation);
    of_tails.count(found.quantiles[0], mean - z * deviation);
    of_median.count(found.quantiles[1], mean);
    of_tails.count(found.quantiles[2], mean + z * deviation);
    largest = std::max(largest, found.mean.error);
  }
  // 100 draws of 95 %: five standard deviations below are 84 %
  for (const Cover& cover : {of_mean, of_deviation, of_tails, of_median}) CHECK(cover.share() >= 0.84);
  CHECK(largest < 0.2 * 1.96 * deviation / std::sqrt(512.0));  // a fifth of what 512 plain draws have
}

TEST_CASE("512 points tell P10, P50 and P90 as 100,000 plain draws do", "[studies][scatter][statistics]") {
  // Resistance of a layer with one relaxation time: a peak over speed times time, the less the stiffer it is.
  const auto resistance = [](double g, double tau) {
    const double x = 2 * tau;
    return 400 * std::sqrt(3e6 / g) * x / (1 + x * x);
  };
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  ScatterBatches plain(20);
  for (std::size_t i = 0; i < 100'000; ++i) {
    const double g = 3e6 + 3e5 * normal(random), tau = 0.25 * std::exp(0.2 * normal(random));
    plain[i % 20].push_back(resistance(g, tau));
  }
  const ScatterStatistics draws = scatter_statistics(plain, tenths);
  const ScatterStatistics points = scatter_statistics(scattered(8, 64, 1, 0, modulus, time_, resistance), tenths);
  for (std::size_t i = 0; i < 3; ++i) {
    CAPTURE(i);
    const auto &one = points.quantiles[i], &other = draws.quantiles[i];
    CHECK(std::abs(one.value - other.value) <= std::hypot(one.error, other.error));
    CHECK(one.error < 0.03 * points.deviation.value * 10);  // no empty promise
  }
  CHECK(std::abs(points.mean.value - draws.mean.value) <= std::hypot(points.mean.error, draws.mean.error));
}

TEST_CASE("points without an answer are left out and counted", "[studies][scatter][statistics]") {
  const ScatterStatistics found = scatter_statistics({{1, none, 3}, {2, 2}}, {0.5});
  CHECK(found.values == 4);
  CHECK(found.without == 1);
  CHECK(found.mean.value == 2);
  CHECK(found.mean.error == 0);
  CHECK(found.deviation.value == Approx(std::sqrt(2.0 / 3)));
  CHECK(found.quantiles[0].value == 2);
  CHECK(std::isnan(scatter_statistics({{1, 2}, {none}}, {}).mean.error));
  CHECK(std::isnan(scatter_statistics({{1, 2}}, {}).mean.error));
  CHECK(std::isnan(scatter_statistics({{none}}, {0.5}).quantiles[0].value));
}

TEST_CASE("quantiles between sorted values lie on straight lines", "[studies][scatter][statistics]") {
  const std::vector<double> four{1, 2, 4, 8};
  CHECK(quantile_of_sorted(four, 0.125) == 1);
  CHECK(quantile_of_sorted(four, 0.5) == 3);
  CHECK(quantile_of_sorted(four, 0.75) == 6);
  CHECK(quantile_of_sorted(four, 0.001) == 1);
  CHECK(quantile_of_sorted(four, 0.999) == 8);
}

TEST_CASE("a smooth quantile moves with every value near it", "[studies][scatter][statistics]") {
  // of a symmetric sample the median is its middle; n = 2: the weights are 1/2 each
  CHECK(smooth_quantile({5, 1, 3}, 0.5) == Approx(3).epsilon(1e-14));
  CHECK(smooth_quantile({1, 2}, 0.5) == Approx(1.5).epsilon(1e-14));
  std::vector<double> values(101);
  std::iota(values.begin(), values.end(), 0.0);
  CHECK(smooth_quantile(values, 0.9) == Approx(90).margin(0.5));
  // Where two values pass each other the slope changes as the weights of neighbours do, by a part of it; the quantile
  // on straight lines would change from all to nothing.
  const auto at = [&](double x) {
    auto moved = values;
    moved[89] = x;
    return smooth_quantile(moved, 0.9);
  };
  const double before = (at(90) - at(89.5)) / 0.5, behind = (at(90.5) - at(90)) / 0.5;
  CHECK(before > 0);
  CHECK(std::abs(behind - before) < 0.3 * before);
}

TEST_CASE("a histogram holds all values, each in its bin", "[studies][scatter][statistics]") {
  std::vector<double> values;
  for (int i = 0; i < 1000; ++i) values.push_back(i < 900 ? 1 + 0.001 * i : 5);
  const auto bins = histogram_of_sorted(values);
  double sum = 0;
  for (const HistogramBin& bin : bins) sum += bin.share;
  CHECK(sum == Approx(1).epsilon(1e-12));
  CHECK(bins.front().from == 1);
  CHECK(bins.back().to == 5);
  CHECK(bins.back().share == Approx(0.1));
  CHECK(histogram_of_sorted({2, 2, 2}).size() == 1);
  CHECK(histogram_of_sorted({}).empty());
}
