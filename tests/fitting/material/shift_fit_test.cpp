#include "fitting/material/shift_fit.hpp"

#include <cmath>
#include <optional>
#include <random>

#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"

using namespace rollres;

namespace {

std::vector<MeasuredShift> factors(const TemperatureShift& law, double noise, std::uint64_t seed = 1) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<MeasuredShift> data;
  for (double temperature = 253.15; temperature < 335; temperature += 10)
    data.push_back({temperature, shift_factor(law, temperature) * std::exp(noise * normal(random))});
  return data;
}

}  // namespace

TEST_CASE("shift factors give back the constants of their law", "[fitting][material_fit]") {
  const TemperatureShift wlf{ShiftLaw::wlf, 293.15, 8.86, 101.6, 0};
  const ShiftFit found = fit_shift(factors(wlf, 0), {ShiftLaw::wlf, 293.15}, std::nan(""));
  CHECK(found.shift.c1 == Approx(8.86).epsilon(1e-6));
  CHECK(found.shift.c2 == Approx(101.6).epsilon(1e-6));
  CHECK(reference_of(factors(wlf, 0)) == 293.15);
  const TemperatureShift vft{.law = ShiftLaw::vft, .reference = 293.15, .vft_b = 2000, .vft_temperature = 190};
  const ShiftFit as_vft = fit_shift(factors(vft, 0), {ShiftLaw::vft, 293.15}, std::nan(""));
  CHECK(as_vft.shift.vft_b == Approx(2000).epsilon(1e-5));
  CHECK(as_vft.shift.vft_temperature == Approx(190).epsilon(1e-5));

  const TemperatureShift arrhenius{ShiftLaw::arrhenius, 293.15, 0, 0, 1.2e5};
  const ShiftFit other = fit_shift(factors(arrhenius, 0), {ShiftLaw::arrhenius, 293.15}, std::nan(""));
  CHECK(other.shift.activation_energy == Approx(1.2e5).epsilon(1e-6));
  CHECK_THAT(message_of([&] {
               fit_shift({{280, 2.0}, {300, 0.5}}, {ShiftLaw::wlf, 293.15}, 0.1);
             }),
             Catch::Contains("too few"));
}

TEST_CASE("the row of a table that is 1 by definition is no datum, and the law may have another reference",
          "[fitting][material_fit]") {
  const TemperatureShift wlf{ShiftLaw::wlf, 293.15, 8.86, 101.6, 0};
  std::vector<MeasuredShift> table = factors(wlf, 0);
  REQUIRE(table.size() == 9);
  const std::optional<double> reference = take_reference(table);
  CHECK(reference == 293.15);
  CHECK(table.size() == 8);
  CHECK_FALSE(take_reference(table));
  // c1 c2 and T0 - c2 do not depend on the reference.
  for (const double other : {263.15, 293.15, 303.15}) {
    const ShiftFit found = fit_shift(table, {ShiftLaw::wlf, other}, std::nan(""), {}, reference);
    CHECK(found.shift.c2 == Approx(101.6 + other - 293.15).epsilon(1e-6));
    CHECK(found.shift.c1 * found.shift.c2 == Approx(8.86 * 101.6).epsilon(1e-6));
    const ShiftFit as_vft = fit_shift(table, {ShiftLaw::vft, other}, std::nan(""), {}, reference);
    CHECK(as_vft.shift.vft_b == Approx(8.86 * 101.6 * std::log(10.0)).epsilon(1e-5));
    CHECK(as_vft.shift.vft_temperature == Approx(293.15 - 101.6).epsilon(1e-5));
  }
}

TEST_CASE("intervals of a shift's constants hold the truth as often as they say", "[fitting][material_fit]") {
  const TemperatureShift wlf{ShiftLaw::wlf, 293.15, 8.86, 101.6, 0};
  int held = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const ShiftFit found = fit_shift(factors(wlf, 0.1, seed), {ShiftLaw::wlf, 293.15}, 0.1);
    const ConfidenceInterval& interval = found.report.parameters[0].profile.interval;
    held += interval.lowest <= 8.86 && interval.highest >= 8.86;
  }
  CHECK(held >= 88);  // three deviations of the binomial distribution below 95
}
