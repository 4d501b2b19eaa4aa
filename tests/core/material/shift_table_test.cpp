#include "core/material/shift_table.hpp"

#include <algorithm>
#include <cmath>

#include "core/material/material.hpp"
#include "core/material/material_scale.hpp"
#include "tests/catch.hpp"

using namespace rollres;

namespace {

constexpr double at_reference = 293.15;

/// A Zener solid with a table of a law of shift, and of b = T0/T, from 233 to 353 K.
MaterialInputs with_table(const TemperatureShift& law, int rows) {
  MaterialInputs layer;
  layer.static_shear_modulus = 1e6;
  layer.stiffening = 2;
  layer.creep_time = 0.1;
  layer.reference_temperature = at_reference;
  for (int i = 0; i < rows; ++i) {
    const double temperature = 353.15 - 120.0 * i / (rows - 1);  // in any order
    layer.shift_temperatures.push_back(temperature);
    layer.shift_factors.push_back(shift_factor(law, temperature));
    layer.modulus_shifts.push_back(at_reference / temperature);
  }
  return layer;
}

}  // namespace

TEST_CASE("a table of shifts of Arrhenius', WLF's or VFT's law is that law at its rows and between them",
          "[core][material]") {
  const TemperatureShift arrhenius{.law = ShiftLaw::arrhenius, .reference = at_reference, .activation_energy = 1e5};
  const TemperatureShift wlf{.law = ShiftLaw::wlf, .reference = at_reference, .c1 = 8.86, .c2 = 101.6};
  const TemperatureShift vft{.law = ShiftLaw::vft, .reference = at_reference, .vft_b = 2000, .vft_temperature = 190};
  const auto check = [](const TemperatureShift& law, int rows) {
    MaterialInputs layer = with_table(law, rows);
    // These laws are hyperbolas, as the pieces between the rows are: what is left is rounding, of ln a up to 30.
    for (const double temperature : {233.15, 233.2, 240.0, 271.3, 293.15, 313.15, 352.9, 353.15}) {
      layer.temperature = temperature;
      CHECK(time_shift(layer) == Approx(shift_factor(law, temperature)).epsilon(1e-11));
    }
  };
  for (const int rows : {2, 3, 13}) check(arrhenius, rows);
  check(wlf, 13);
  check(vft, 13);
}

TEST_CASE("b_T of an entropic rubber, T0/T, is met between the rows the closer the more of them there are",
          "[core][material]") {
  const TemperatureShift none{};
  double coarse = 0;
  for (const int rows : {7, 13}) {
    MaterialInputs layer = with_table(none, rows);
    double worst = 0;
    for (double temperature = 233.15; temperature < 353.15; temperature += 0.7) {
      layer.temperature = temperature;
      worst = std::max(worst, std::abs(modulus_shift(layer) / (at_reference / temperature) - 1));
    }
    CHECK(worst < 2e-5);                        // beside the ends h^3 (ln T)"'/60 at most, with rows h = 20 K apart
    if (coarse > 0) CHECK(worst < coarse / 7);  // at least third order: 8
    coarse = worst;
  }
}

TEST_CASE("between the rows of a measured table nothing overshoots", "[core][material]") {
  // The flat pieces stay flat, and the factor falls where the table does.
  const std::vector<double> temperatures{280, 290, 300, 310, 311, 340}, factors{10, 10, 1, 0.9, 0.01, 0.01};
  double before = 10;
  for (double temperature = 280; temperature <= 340; temperature += 0.25) {
    const double factor = TableFactors(temperatures, factors)(temperature);
    CHECK(factor <= before * (1 + 1e-12));
    CHECK(factor >= 0.01 * (1 - 1e-12));
    if (temperature <= 290) CHECK(factor == Approx(10));
    before = factor;
  }
  for (std::size_t i = 0; i < temperatures.size(); ++i)
    CHECK(TableFactors(temperatures, factors)(temperatures[i]) == Approx(factors[i]).epsilon(1e-14));
  const std::vector<double> turns{1, 3, 2, 2.5, 2.4, 7};  // up and down: each piece between its rows
  for (double temperature = 280; temperature <= 340; temperature += 0.25) {
    const auto above = std::lower_bound(temperatures.begin() + 1, temperatures.end() - 1, temperature);
    const auto [low, high] = std::minmax(turns[static_cast<std::size_t>(above - temperatures.begin()) - 1],
                                         turns[static_cast<std::size_t>(above - temperatures.begin())]);
    const double factor = TableFactors(temperatures, turns)(temperature);
    CHECK(factor >= low * (1 - 1e-12));
    CHECK(factor <= high * (1 + 1e-12));
  }
}

TEST_CASE("a table of shifts reaches half a step beyond its last rows, 1 K at most, along the slope at its end",
          "[core][material]") {
  const TemperatureShift law{.law = ShiftLaw::vft, .reference = at_reference, .vft_b = 2000, .vft_temperature = 190};
  const std::vector<double> temperatures{353.15, 350.15, 347.15, 240.4, 240};  // steps of 3 K and of 0.4 K at the ends
  std::vector<double> factors;
  for (const double temperature : temperatures) factors.push_back(shift_factor(law, temperature));
  // The line misses the law by (ln a)"/2 = B/(T - T1)^3 over 1 K^2: 5e-4 of a at 353 K, and 0.04 of that of 0.016 at
  // 240 K.
  CHECK(TableFactors(temperatures, factors)(353.166) == Approx(shift_factor(law, 353.166)).epsilon(1e-6));
  CHECK(TableFactors(temperatures, factors)(354.15) == Approx(shift_factor(law, 354.15)).epsilon(6e-4));
  CHECK(TableFactors(temperatures, factors)(239.8) == Approx(shift_factor(law, 239.8)).epsilon(7e-4));
  CHECK(TableFactors(temperatures, factors)(354.15) < TableFactors(temperatures, factors)(353.15));
  CHECK_THROWS(TableFactors(temperatures, factors)(354.2));
  CHECK_THROWS(TableFactors(temperatures, factors)(239.7));
}

TEST_CASE("b_T of a table divides moduli, a_T shifts frequencies: b_T G*(omega, T) = G*(a_T omega, T0)",
          "[core][material]") {
  const TemperatureShift law{.law = ShiftLaw::vft, .reference = at_reference, .vft_b = 2000, .vft_temperature = 190};
  MaterialInputs layer = with_table(law, 13);
  const MaterialInputs at_reference_temperature = layer;
  layer.temperature = layer.shift_temperatures[2];
  const double a = layer.shift_factors[2], b = at_reference / *layer.temperature;
  for (const double omega : {0.01, 1.0, 100.0}) {
    const auto shifted = b * complex_modulus(layer, omega),
               there = complex_modulus(at_reference_temperature, a * omega);
    CHECK(shifted.real() == Approx(there.real()).epsilon(1e-9));
    CHECK(shifted.imag() == Approx(there.imag()).epsilon(1e-9));
  }
  CHECK(static_modulus(layer) == Approx(1e6 * *layer.temperature / at_reference).epsilon(1e-9));
}

TEST_CASE("VFT's law is WLF's with other constants", "[core][material]") {
  const TemperatureShift wlf{.law = ShiftLaw::wlf, .reference = at_reference, .c1 = 8.86, .c2 = 101.6};
  const TemperatureShift vft{.law = ShiftLaw::vft,
                             .reference = at_reference,
                             .vft_b = 8.86 * 101.6 * std::log(10.0),
                             .vft_temperature = at_reference - 101.6};
  for (const double temperature : {230.0, 293.15, 400.0})
    CHECK(shift_factor(vft, temperature) == Approx(shift_factor(wlf, temperature)).epsilon(1e-12));
  CHECK_THROWS(shift_factor(vft, 191.0));
}

TEST_CASE("a table whose a_T rise with temperature is warned of, as it may have been turned round",
          "[core][material]") {
  const TemperatureShift law{.law = ShiftLaw::arrhenius, .reference = at_reference, .activation_energy = 1e5};
  MaterialInputs layer = with_table(law, 3);
  layer.temperature = 300;
  CHECK(material_warnings(layer).empty());
  for (double& factor : layer.shift_factors) factor = 1 / factor;
  REQUIRE(material_warnings(layer).size() == 1);
  CHECK_THAT(material_warnings(layer).front(), Catch::Contains("is 1/a_T meant?"));
}
