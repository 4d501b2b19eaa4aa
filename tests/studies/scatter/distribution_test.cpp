#include "studies/scatter/distribution.hpp"

#include <cmath>

#include "tests/catch.hpp"

using namespace rollres;

namespace {

using Kind = DistributionKind;
const std::vector<Distribution> all{{Kind::normal, {3e6, 3e5}},
                                    {Kind::lognormal, {0.25, 0.2}},
                                    {Kind::uniform, {0.1, 0.3}},
                                    {Kind::loguniform, {1e-3, 1}},
                                    {Kind::triangular, {4e-3, 5e-3, 7e-3}}};

}  // namespace

TEST_CASE("a quantile has its probability below it and the rest above it", "[studies][scatter][distribution]") {
  for (const Distribution& distribution : all)
    for (const double probability : {0.001, 0.1, 0.5, 0.9, 0.999}) {
      CAPTURE(name_of(distribution.kind), probability);
      const double x = quantile(distribution, probability);
      CHECK(weight_below(distribution, x) == Approx(probability).epsilon(1e-9));
      CHECK(weight_above(distribution, x) == Approx(1 - probability).epsilon(1e-9));
    }
}

TEST_CASE("the tails of a normal number keep their digits", "[studies][scatter][distribution]") {
  for (const double probability : {1e-12, 1e-6})
    CHECK(weight_below(all[0], quantile(all[0], probability)) == Approx(probability).epsilon(1e-9));
  CHECK(weight_above(all[0], 3e6 + 7 * 3e5) == Approx(1.279812543885835e-12).epsilon(1e-9));  // erfc(7 / sqrt 2) / 2
}

TEST_CASE("quantiles are those of the tables", "[studies][scatter][distribution]") {
  // Abramowitz and Stegun, table 26.5: the normal quantile at 0.9 is 1.28155 15655
  const double z = 1.2815515655446004;
  CHECK(quantile(all[0], 0.9) == Approx(3e6 + z * 3e5).epsilon(1e-12));
  CHECK(quantile(all[1], 0.1) == Approx(0.25 * std::exp(-0.2 * z)).epsilon(1e-12));
  CHECK(quantile(all[2], 0.25) == Approx(0.15).epsilon(1e-12));
  CHECK(quantile(all[3], 0.5) == Approx(std::sqrt(1e-3)).epsilon(1e-12));
  CHECK(quantile(all[4], 1.0 / 3) == Approx(5e-3).epsilon(1e-12));  // the share of the rising side
}

TEST_CASE("what is cut off leaves its weight to the rest", "[studies][scatter][distribution]") {
  const Distribution whole{Kind::normal, {1, 1}};
  const Distribution cut = cut_off(whole, positive);
  const double below = weight_below(whole, 0);
  CHECK(weight_outside(whole, positive) == Approx(0.15865525393145705).epsilon(1e-12));  // Phi(-1)
  CHECK(quantile(cut, 1e-15) > 0);
  CHECK(quantile(cut, 1e-15) < 1e-13);
  for (const double probability : {0.1, 0.5, 0.9})
    CHECK(weight_below(whole, quantile(cut, probability)) == Approx(below + probability * (1 - below)).epsilon(1e-12));
  CHECK(quantile(cut_off(all[0], positive), 0.3) == quantile(all[0], 0.3));
}

TEST_CASE("a number times a factor has quantiles times the factor", "[studies][scatter][distribution]") {
  for (const Distribution& distribution : all)
    for (const double probability : {0.02, 0.5, 0.98})
      CHECK(quantile(times(distribution, 1000), probability) ==
            Approx(1000 * quantile(distribution, probability)).epsilon(1e-12));
}

TEST_CASE("parameters that make no distribution break a rule", "[studies][scatter][distribution]") {
  for (const Distribution& distribution : all) CHECK(broken_rule(distribution).empty());
  const double infinite = std::numeric_limits<double>::infinity();
  for (const Distribution& wrong : {Distribution{Kind::normal, {0, 0}},
                                    {Kind::normal, {infinite, 1}},
                                    {Kind::lognormal, {0, 1}},
                                    {Kind::lognormal, {1, -1}},
                                    {Kind::uniform, {2, 1}},
                                    {Kind::loguniform, {0, 1}},
                                    {Kind::triangular, {1, 3, 2}}})
    CHECK_FALSE(broken_rule(wrong).empty());
}

TEST_CASE("a distribution is told with its units", "[studies][scatter][distribution]") {
  CHECK(in_words(all[0], "Pa") == "normal, mean 3 MPa, standard deviation 300 kPa");
  CHECK(in_words(all[1], "s") == "lognormal, median 250 ms, standard deviation of the logarithm 0.2");
  CHECK(in_words(all[4], "m") == "triangular from 4 mm to 7 mm, most probable 5 mm");
}
