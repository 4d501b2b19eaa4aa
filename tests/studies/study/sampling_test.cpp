#include "studies/study/sampling.hpp"

#include <cmath>
#include <numeric>
#include <set>

#include "tests/catch.hpp"

using namespace rollres;

namespace {

/// How many of the points lie in each of rows x columns equal boxes of the unit square.
std::vector<int> counts(const std::vector<std::vector<double>>& sample, int rows, int columns) {
  std::vector<int> counted(static_cast<std::size_t>(rows * columns), 0);
  for (std::size_t i = 0; i < sample[0].size(); ++i) {
    const int row = static_cast<int>(sample[0][i] * rows), column = static_cast<int>(sample[1][i] * columns);
    ++counted.at(static_cast<std::size_t>(row * columns + column));
  }
  return counted;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const double n = static_cast<double>(a.size());
  const double mean_a = std::accumulate(a.begin(), a.end(), 0.0) / n;
  const double mean_b = std::accumulate(b.begin(), b.end(), 0.0) / n;
  double ab = 0, aa = 0, bb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - mean_a) * (b[i] - mean_b);
    aa += (a[i] - mean_a) * (a[i] - mean_a);
    bb += (b[i] - mean_b) * (b[i] - mean_b);
  }
  return ab / std::sqrt(aa * bb);
}

}  // namespace

TEST_CASE("the first points of the sequence of Sobol' are those that Joe and Kuo publish", "[studies][sampling]") {
  // https://web.maths.unsw.edu.au/~fkuo/sobol/: the first ten points in three dimensions
  const std::vector<std::vector<double>> published{{0, 0.5, 0.75, 0.25, 0.375, 0.875, 0.625, 0.125, 0.1875, 0.6875},
                                                   {0, 0.5, 0.25, 0.75, 0.375, 0.875, 0.125, 0.625, 0.3125, 0.8125},
                                                   {0, 0.5, 0.25, 0.75, 0.625, 0.125, 0.875, 0.375, 0.9375, 0.4375}};
  CHECK(unit_sample(SampleMethod::sobol, 10, 3) == published);
}

TEST_CASE("every elementary box of the unit square holds one point of Sobol', shifted or not", "[studies][sampling]") {
  for (const std::uint64_t seed : {0, 1, 12345}) {
    CAPTURE(seed);
    const auto sample = unit_sample(SampleMethod::sobol, 64, 2, seed);
    for (int rows = 1; rows <= 64; rows *= 2) CHECK(counts(sample, rows, 64 / rows) == std::vector<int>(64, 1));
  }
  CHECK(unit_sample(SampleMethod::sobol, 64, 2, 1) != unit_sample(SampleMethod::sobol, 64, 2, 2));
}

TEST_CASE("each of n parts of each side holds one of n points of a Latin hypercube", "[studies][sampling]") {
  for (const std::uint64_t seed : {0, 1, 2}) {
    CAPTURE(seed);
    const auto sample = unit_sample(SampleMethod::latin_hypercube, 100, 5, seed);
    REQUIRE(sample.size() == 5);
    for (const auto& column : sample) {
      std::set<int> parts;
      for (const double value : column) parts.insert(static_cast<int>(std::floor(value * 100)));
      CHECK(parts.size() == 100);
      CHECK(*parts.begin() == 0);
      CHECK(*parts.rbegin() == 99);
    }
    // two random orders of 100: a standard deviation of 0.1, and ten pairs
    for (std::size_t i = 0; i < 5; ++i)
      for (std::size_t j = 0; j < i; ++j) CHECK(std::abs(correlation(sample[i], sample[j])) < 0.4);
  }
}

TEST_CASE("a sample is told by its seed alone, on every machine", "[studies][sampling]") {
  for (const SampleMethod method : {SampleMethod::sobol, SampleMethod::latin_hypercube}) {
    CHECK(unit_sample(method, 20, 3, 7) == unit_sample(method, 20, 3, 7));
    CHECK(unit_sample(method, 20, 3, 7) != unit_sample(method, 20, 3, 8));
  }
  // The generator is the one of the C++ standard; the digits were computed with Python from its definition.
  const auto sample = unit_sample(SampleMethod::latin_hypercube, 4, 1, 5489);
  CHECK(sample[0] ==
        std::vector<double>{0.48666695022257045, 0.7548177645076066, 0.1012255362002179, 0.5628294544294477});
}

TEST_CASE("scrambled points of Sobol' are a net, and uniform over all scramblings", "[studies][sampling]") {
  double mean = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const auto sample = scrambled_sobol(64, 2, seed);
    if (seed < 3)
      for (int rows = 1; rows <= 64; rows *= 2) CHECK(counts(sample, rows, 64 / rows) == std::vector<int>(64, 1));
    mean += sample[0][5] / 200;
  }
  CHECK(mean == Approx(0.5).margin(5 / std::sqrt(12.0 * 200)));  // five standard deviations
}

TEST_CASE("scrambled points integrate a product far better than plain draws", "[studies][sampling]") {
  // The integral of x y over the unit square is 1/4; plain draws have a variance of (1/9 - 1/16) / n.
  double squares = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const auto sample = scrambled_sobol(64, 2, seed);
    double sum = 0;
    for (std::size_t i = 0; i < 64; ++i) sum += sample[0][i] * sample[1][i] / 64;
    squares += (sum - 0.25) * (sum - 0.25) / 50;
  }
  CHECK(squares < (1.0 / 9 - 1.0 / 16) / 64 / 50);
}

TEST_CASE("batches of a sample are independent, and a seed tells them all", "[studies][sampling]") {
  for (const SampleMethod method : {SampleMethod::sobol, SampleMethod::latin_hypercube}) {
    const auto sample = batched_sample(method, 4, 8, 2, 1);
    REQUIRE(sample.size() == 2);
    REQUIRE(sample[0].size() == 32);
    CHECK(sample == batched_sample(method, 4, 8, 2, 1));
    CHECK(sample != batched_sample(method, 4, 8, 2, 2));
    for (const double place : sample[0]) CHECK((place > 0 && place < 1));
    CHECK(std::vector<double>(sample[0].begin(), sample[0].begin() + 8) !=
          std::vector<double>(sample[0].begin() + 8, sample[0].begin() + 16));
  }
}
