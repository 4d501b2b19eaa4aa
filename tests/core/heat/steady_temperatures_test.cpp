#include "core/heat/steady_temperatures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "tests/catch.hpp"

using namespace rollres;

namespace {

/// One peak of the loss of a Zener solid over the temperature, whose times fall by e in each 1/b kelvin.
struct NarrowPeak {
  double air = 253, rise_at_peak = 100, cold = 150,
         fall = 0.1;  // [K], [K], omega tau at the air's temperature, b [1/K]

  double rise(double temperature) const {
    const double x = cold * std::exp(-fall * (temperature - air));
    return rise_at_peak * 2 * x / (1 + x * x);
  }
  double excess(double temperature) const { return air + rise(temperature) - temperature; }

  /// By the changes of sign between many temperatures.
  std::vector<double> states() const {
    std::vector<double> found;
    const int count = 20000;
    for (int i = 0; i < count; ++i) {
      const double low = air + 400.0 * i / count, high = air + 400.0 * (i + 1) / count;
      if ((excess(low) > 0) != (excess(high) > 0))
        found.push_back(low - excess(low) * (high - low) / (excess(high) - excess(low)));
    }
    return found;
  }
};

/// An estimate of it that is off by a third, and more so with the temperature.
RiseEstimate rough(const NarrowPeak& peak) {
  RiseEstimate estimate;
  for (double temperature = peak.air; temperature < peak.air + 400; temperature += 4) {
    estimate.temperatures.push_back(temperature);
    estimate.rise.push_back(0.01 * peak.rise(temperature + 1.5) * (1 + 0.1 * std::sin(0.02 * temperature)));
  }
  estimate.factor = 130;
  estimate.base = peak.air;
  return estimate;
}

struct Counted {
  SteadyTemperatures found;
  int answers = 0;
};

Counted search(const NarrowPeak& peak) {
  Counted counted;
  counted.found = steady_temperatures(rough(peak), [&](double temperature) {
    ++counted.answers;
    return std::optional<HeatBalance>({peak.air, peak.rise(temperature)});
  });
  return counted;
}

}  // namespace

TEST_CASE("a material on the rubbery side has one stable state, found in few answers", "[core][heat]") {
  const NarrowPeak peak{293, 60, 0.8, 0.05};
  const Counted counted = search(peak);
  REQUIRE(counted.found.states.size() == 1);
  CHECK(counted.found.states[0].stable);
  CHECK(std::abs(peak.excess(counted.found.states[0].temperature)) < 3e-6);
  CHECK(counted.answers <= 8);
}

TEST_CASE("a narrow peak above a cold start has a cold and a warm state, both stable, and an unstable one between",
          "[core][heat]") {
  const NarrowPeak peak;
  REQUIRE(peak.states().size() == 3);
  const Counted counted = search(peak);
  REQUIRE(counted.found.states.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(counted.found.states[i].temperature == Approx(peak.states()[i]).epsilon(1e-6));
    CHECK(counted.found.states[i].stable == (i != 1));
  }
}

// Fails where the state at the coldest temperature counts as unstable: the unstable one beside it was left out.
TEST_CASE("a cover that loses nothing in the cold has a stable state there, and an unstable one between",
          "[core][heat]") {
  const NarrowPeak peak{263, 150, std::exp(40), 0.6};
  REQUIRE(peak.excess(peak.air) == 0);
  const Counted counted = search(peak);
  REQUIRE(counted.found.states.size() == 3);
  CHECK(counted.found.states[0].temperature == peak.air);
  for (std::size_t i = 0; i < 3; ++i) CHECK(counted.found.states[i].stable == (i != 1));
}

// What the estimate does not see, as states that touch one another within its error, may be missed.
TEST_CASE("all states of random peaks are found that a dense scan finds", "[core][heat]") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(0, 1);
  int several = 0, compared = 0, ones = 0, answers = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const NarrowPeak peak{250 + 50 * share(random), 150 * share(random), std::exp(6 * share(random) - 1),
                          0.02 + 0.13 * share(random)};
    const std::vector<double> wanted = peak.states();
    double nearest = 400;
    for (std::size_t i = 1; i < wanted.size(); ++i) nearest = std::min(nearest, wanted[i] - wanted[i - 1]);
    if (nearest < 1) continue;
    ++compared;
    several += wanted.size() > 1;
    const Counted counted = search(peak);
    INFO("trial " << trial << ": " << counted.answers << " answers");
    REQUIRE(counted.found.states.size() == wanted.size());
    for (std::size_t i = 0; i < wanted.size(); ++i)
      CHECK(counted.found.states[i].temperature == Approx(wanted[i]).epsilon(1e-6));
    if (wanted.size() == 1) answers += counted.answers;
    ones += wanted.size() == 1;
  }
  CHECK(several > 20);
  CHECK(compared > 250);
  CHECK(answers < 6 * ones);
}

TEST_CASE("states of an excess that is flat for some kelvin are told once each", "[core][heat]") {
  // A random scene: three states, between which the excess is some thousandths of a kelvin.
  constexpr double cold = 317.529, middle = 318.348, warm = 321.329;
  const auto excess = [&](double at) {
    const double flat = (at - cold) * (at - middle) * (at - warm), far = at - middle;
    return -5e-4 * flat / (1 + 1e-3 * far * far);
  };
  RiseEstimate estimate{{}, {}, 1, 282};
  for (double at = 282; at < 600; at += 4) {
    estimate.temperatures.push_back(at);
    estimate.rise.push_back(std::max(1.0, 34.7 * std::exp(-0.02 * std::abs(at - 325))));
  }
  const SteadyTemperatures found = steady_temperatures(estimate, [&](double at) {
    return std::optional<HeatBalance>({282, std::max(0.5, at - 282 + excess(at))});
  });
  REQUIRE(!found.states.empty());
  CHECK(found.states.size() % 2 == 1);
  for (std::size_t i = 0; i < found.states.size(); ++i) {
    const double at = found.states[i].temperature;
    CAPTURE(i, at);
    CHECK(found.states[i].stable == (i % 2 == 0));
    CHECK(std::min({std::abs(at - cold), std::abs(at - middle), std::abs(at - warm)}) < 0.05);
  }
}

TEST_CASE("states are found where the estimate passes by within its error, without a turn", "[core][heat]") {
  // The rise of a random scene, whose excess is -0.22 K at 299 and +0.38 K at 304 K; the estimate falls behind by 1.2 %
  // a kelvin, and falls all the way.
  constexpr std::array<double, 19> at{289, 291, 293, 295, 296, 297, 298, 299, 300, 301,
                                      302, 303, 304, 306, 308, 310, 320, 340, 400};
  constexpr std::array<double, 19> known{0.920, 1.351,  1.972,  2.854,  3.420, 4.086,  4.860, 5.749, 6.751, 7.850,
                                         9.007, 10.158, 11.214, 12.709, 13.1,  12.478, 4.561, 0.260, 1e-3};
  constexpr double base = 293.02;
  const auto rise = [&](double temperature) {
    const auto above = static_cast<std::size_t>(std::upper_bound(at.begin(), at.end(), temperature) - at.begin());
    const std::size_t i = std::clamp<std::size_t>(above, 1, at.size() - 1);
    const double share = (temperature - at[i - 1]) / (at[i] - at[i - 1]);
    return std::exp((1 - share) * std::log(known[i - 1]) + share * std::log(known[i]));
  };
  std::vector<double> wanted;
  for (double low = 289; low < 390; low += 0.01)
    if ((base + rise(low) > low) != (base + rise(low + 0.01) > low + 0.01)) wanted.push_back(low);
  REQUIRE(wanted.size() == 3);
  RiseEstimate estimate{{}, {}, 1, base};
  for (double temperature = 289; temperature < 390; temperature += 2.5) {
    estimate.temperatures.push_back(temperature);
    estimate.rise.push_back(rise(temperature) * std::exp(-0.012 * (temperature - 297.4)));
  }
  const SteadyTemperatures found = steady_temperatures(estimate, [&](double place) {
    return std::optional<HeatBalance>({base, rise(place)});
  });
  REQUIRE(found.states.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) CHECK(found.states[i].temperature == Approx(wanted[i]).margin(0.02));
}

TEST_CASE("where more is lost than leaves up to the last temperature there is no state, and it is told",
          "[core][heat]") {
  RiseEstimate estimate{{293, 393, 493, 693}, {1, 1, 1, 1}, 30, 293};
  const SteadyTemperatures found = steady_temperatures(estimate, [](double) {
    return std::optional<HeatBalance>({293, 900});
  });
  CHECK(found.states.empty());
  REQUIRE(found.beyond);
  CHECK(*found.beyond == 693);
}

TEST_CASE("a temperature without an answer ends the search, and layers that lose nothing are as warm as what is around",
          "[core][heat]") {
  RiseEstimate estimate{{293, 393, 493, 693}, {1, 1, 1, 1}, 30, 293};
  const SteadyTemperatures unanswered =
      steady_temperatures(estimate, [](double) { return std::optional<HeatBalance>(); });
  REQUIRE(unanswered.unanswered);
  CHECK(*unanswered.unanswered == Approx(323));
  const SteadyTemperatures cold = steady_temperatures(estimate, [](double) {
    return std::optional<HeatBalance>({293, 0});
  });
  REQUIRE(cold.states.size() == 1);
  CHECK(cold.states[0].temperature == Approx(293).epsilon(1e-8));
}
