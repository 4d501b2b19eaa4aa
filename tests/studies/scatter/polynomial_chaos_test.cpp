#include "studies/scatter/polynomial_chaos.hpp"

#include <cmath>
#include <limits>

#include "studies/scatter/surrogate_statistics.hpp"
#include "studies/study/uncertain.hpp"
#include "tests/catch.hpp"

// Covers surrogate_statistics, too.

using namespace rollres;

namespace {

/// Two inputs, 3 MPa normal by 10 % and 0.25 s lognormal by 20 %, in batches.
UncertainInputs rubber(std::size_t points, std::vector<CorrelatedPair> pairs = {}) {
  UncertainInputs uncertain;
  uncertain.inputs = {{.key = "static_shear_modulus", .distribution = {DistributionKind::normal, {3e6, 3e5}}},
                      {.key = "creep_time", .distribution = {DistributionKind::lognormal, {0.25, 0.2}}}};
  uncertain.correlations = std::move(pairs);
  uncertain.points = points;
  uncertain.scramblings = 8;
  return uncertain;
}

struct Sampled {
  SurrogatePoints points;
  ScatterBatches batches;
};

/// @param function  of modulus and time
template <class Function>
Sampled sampled_at(const UncertainInputs& uncertain, Function function) {
  const auto uniform = uncertain_points(uncertain);
  Sampled result;
  result.points.fitted = germs_of(uncertain, uniform);
  UncertainInputs many = uncertain;
  many.points = 1U << 14U;
  many.scramblings = 8;
  result.points.wanted = germs_of(many, uncertain_points(many)).points;
  result.batches.resize(uncertain.scramblings);
  for (std::size_t i = 0; i < uncertain.points; ++i)
    result.batches[i / uncertain.points_of_each()].push_back(function(
        quantile(uncertain.inputs[0].own(), uniform[0][i]), quantile(uncertain.inputs[1].own(), uniform[1][i])));
  return result;
}

double power_law(double modulus, double time) { return std::sqrt(modulus / 3e6) * (time / 0.25); }
const std::vector<double> deciles{0.1, 0.5, 0.9};

}  // namespace

TEST_CASE("a polynomial of germs is found whole, with few terms and no error", "[studies][scatter][chaos]") {
  GermPoints at{{Germ::normal, Germ::uniform}, Eigen::MatrixXd(40, 2)};
  Eigen::VectorXd values(40);
  for (int i = 0; i < 40; ++i) {
    const double z = std::sin(1.7 * i) * 2, u = std::cos(2.3 * i);
    at.points.row(i) << z, u;
    values[i] = 2 + 3 * z + z * z * u - 0.5 * u * u * u;
  }
  const PolynomialChaos chaos(at, values);
  CHECK(chaos.degree() == 3);
  CHECK(chaos.terms() <= 6);  // He2 = z^2 - 1: u has a term of its own, u^3 two
  CHECK(chaos.error() < 1e-10);
  const Eigen::MatrixXd there = (Eigen::MatrixXd(1, 2) << 0.7, -0.3).finished();
  CHECK((chaos.terms_at(there) * chaos.coefficients())(0) == Approx(2 + 2.1 - 0.147 + 0.0135).epsilon(1e-10));
}

TEST_CASE("the surrogate of a power law of lognormal numbers has its closed form's mean, deviation and quantiles",
          "[studies][scatter][chaos]") {
  // y = x1^a x2^b with both lognormal is lognormal: ln y of deviation s = |(a s1, b s2)|.
  UncertainInputs uncertain = rubber(64);
  uncertain.inputs[0].distribution = {DistributionKind::lognormal, {3e6, 0.1}};
  const Sampled at = sampled_at(uncertain, power_law);
  const auto found = surrogate_statistics(at.points, at.batches, deciles);
  REQUIRE(found);
  const double s = std::hypot(0.05, 0.2), z90 = 1.2815515655;
  const double mean = std::exp(s * s / 2), deviation = mean * std::sqrt(std::exp(s * s) - 1);
  const ScatterStatistics plain = scatter_statistics(at.batches, deciles);
  CHECK(is_surer(*found, plain));
  CHECK(found->error < 1e-3);
  const auto check = [](const ScatterEstimate& estimate, double exact) {
    CHECK(std::abs(estimate.value - exact) <= estimate.error);
  };
  check(found->mean, mean);
  check(found->deviation, deviation);
  check(found->quantiles[0], std::exp(-z90 * s));
  check(found->quantiles[1], 1);
  check(found->quantiles[2], std::exp(z90 * s));
  CHECK(found->quantiles[2].error < 0.1 * plain.quantiles[2].error);

  const auto likely = surrogate_probability(at.points, [&] {
    ScatterBatches excess = at.batches;
    for (auto& batch : excess)
      for (double& value : batch) value = std::exp(z90 * s) - value;  // holds where y is above its P90
    return excess;
  }());
  REQUIRE(likely);
  CHECK(std::abs(likely->value - 0.1) <= likely->error);
}

TEST_CASE("a surrogate of 64 points agrees with full sampling, also where the inputs correlate",
          "[studies][scatter][chaos]") {
  const auto function = [](double modulus, double time) {
    return power_law(modulus, time) / (1 + std::pow(time / 0.25, 2)) + 0.1 * std::log(modulus / 3e6);
  };
  const std::vector<CorrelatedPair> pairs{{0, 1, -0.4}};
  const Sampled few = sampled_at(rubber(64, pairs), function);
  const Sampled many = sampled_at(rubber(1U << 16U, pairs), function);
  const auto found = surrogate_statistics(few.points, few.batches, deciles);
  REQUIRE(found);
  const ScatterStatistics full = scatter_statistics(many.batches, deciles);
  CHECK(is_surer(*found, scatter_statistics(few.batches, deciles)));
  CHECK(std::abs(found->mean.value - full.mean.value) <= found->mean.error + full.mean.error);
  CHECK(std::abs(found->deviation.value - full.deviation.value) <= found->deviation.error + full.deviation.error);
  for (std::size_t i = 0; i < deciles.size(); ++i)
    CHECK(std::abs(found->quantiles[i].value - full.quantiles[i].value) <=
          found->quantiles[i].error + full.quantiles[i].error);
}

TEST_CASE("a jump that no polynomial follows is left to the points", "[studies][scatter][chaos]") {
  const Sampled at = sampled_at(rubber(64), [](double modulus, double) { return modulus > 3.1e6 ? 1.0 : 0.0; });
  const auto found = surrogate_statistics(at.points, at.batches, deciles);
  REQUIRE(found);
  CHECK(found->error > 0.1);
  CHECK_FALSE(is_surer(*found, scatter_statistics(at.batches, deciles)));
}

TEST_CASE("without all answers, or a spread, there is no surrogate", "[studies][scatter][chaos]") {
  Sampled at = sampled_at(rubber(64), power_law);
  at.batches[3][2] = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(surrogate_statistics(at.points, at.batches, deciles));
  CHECK_FALSE(surrogate_probability(at.points, at.batches));
  const Sampled same = sampled_at(rubber(64), [](double, double) { return 1.0; });
  CHECK_FALSE(surrogate_statistics(same.points, same.batches, deciles));
}
