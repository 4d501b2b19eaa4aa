#include "core/material/passivity.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "core/material/fractional_zener.hpp"
#include "tests/catch.hpp"

using namespace rollres;

namespace {

/// A fractional solid's moduli over eight decades, normal errors of a relative deviation on each.
MasterCurve drawn_curve(double noise, int rows = 60) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  MasterCurve curve;
  for (int i = 0; i < rows; ++i) {
    const double frequency = std::pow(10, -3 + 8.0 * i / (rows - 1));
    const auto modulus = complex_modulus(FractionalZener{1e6, 300, 2, 0.5}, 2 * std::numbers::pi * frequency);
    curve.frequencies.push_back(frequency);
    curve.storage.push_back(modulus.real() * (1 + noise * normal(random)));
    curve.loss.push_back(modulus.imag() * (1 + noise * normal(random)));
  }
  return curve;
}

/// The same with a rise of the storage modulus that is a part of what the loss implies.
MasterCurve flattened(MasterCurve curve, double part) {
  const double first = curve.storage.front();
  for (double& storage : curve.storage) storage = first + part * (storage - first);
  return curve;
}

}  // namespace

TEST_CASE("moduli of a passive solid belong together, with scatter too", "[core][material]") {
  for (const double noise : {0.0, 0.02, 0.1, 0.2}) {
    CAPTURE(noise);
    const PassivityTest test = passivity_test(drawn_curve(noise));
    CHECK(!test.contradiction);
    CHECK(test.in_words().empty());
    CHECK(test.misfit < 1.5 * noise + 1e-3);
    // The integral of the loss misses what lies beyond the table: a tenth of the rise here.
    if (noise < 0.1) CHECK(test.implied_rise == Approx(test.measured_rise).epsilon(0.12));
  }
}

TEST_CASE("a loss that implies four times the rise of the storage modulus is named, with where", "[core][material]") {
  const PassivityTest test = passivity_test(flattened(drawn_curve(0.02), 0.25));
  CHECK(test.contradiction);
  CHECK(test.misfit > 0.2);
  CHECK(test.implied_rise / test.measured_rise == Approx(4).epsilon(0.12));
  REQUIRE(test.worst.size() == 3);
  for (std::size_t i = 1; i < 3; ++i) CHECK(std::abs(std::log10(test.worst[i] / test.worst[0])) >= 0.5);
  CHECK_THAT(test.in_words(), Catch::StartsWith("storage and loss contradict each other (Kramers and Kronig): the loss "
                                                "implies ") &&
                                  Catch::Contains("no passive material comes nearer than") && Catch::EndsWith(" Hz"));
  CHECK(test.in_words().find('\n') == std::string::npos);
}

TEST_CASE(
    "moduli whose loss is above the storage in most rows are asked whether they were exchanged, a glass "
    "transition is not",
    "[core][material]") {
  const std::vector<double> storage{1e6, 2e6, 8e6, 40e6, 300e6}, loss{0.1e6, 0.5e6, 10e6, 70e6, 60e6};
  CHECK(swapped_moduli(storage, loss).empty());
  CHECK(swapped_moduli(loss, storage) ==
        "the loss modulus is above the storage modulus in 3 of 5 rows: are the two swapped?");
  CHECK(swapped_moduli({}, {}).empty());
  const auto remarked = [](const std::vector<double>& first, const std::vector<double>& second) {
    const auto remarks = fit_master_curve({{1, 10, 100, 1e3, 1e4}, first, second}).remarks;
    return std::any_of(remarks.begin(), remarks.end(),
                       [](const std::string& remark) { return remark.find("swapped?") != std::string::npos; });
  };
  CHECK_FALSE(remarked(storage, loss));
  CHECK(remarked(loss, storage));
}

TEST_CASE("a storage modulus that does not rise beside a loss is a contradiction", "[core][material]") {
  MasterCurve curve = drawn_curve(0.02);
  std::fill(curve.storage.begin(), curve.storage.end(), 2e6);
  std::fill(curve.loss.begin(), curve.loss.end(), 5e5);
  CHECK_THAT(passivity_test(curve).in_words(), Catch::Contains("does not rise as the loss implies"));
}

TEST_CASE("a master curve that contradicts itself is told in one line, not row by row", "[core][material]") {
  const MasterCurveFit bad = fit_master_curve(flattened(drawn_curve(0.1), 0.25));
  int contradictions = 0;
  for (const std::string& remark : bad.remarks) {
    contradictions += remark.starts_with("master curve: storage and loss contradict");
    CHECK(remark.find("falls from") == std::string::npos);
  }
  CHECK(contradictions == 1);
  // Scatter is no contradiction; the many rows that fall are one line.
  const MasterCurveFit noisy = fit_master_curve(drawn_curve(0.1));
  REQUIRE(noisy.remarks.size() == 1);
  CHECK_THAT(noisy.remarks.front(), Catch::Contains("falls from") && Catch::Contains("; likewise at "));
}
