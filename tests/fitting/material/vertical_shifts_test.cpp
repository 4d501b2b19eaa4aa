#include "fitting/material/vertical_shifts.hpp"

#include <cmath>
#include <random>

#include "fitting/material/free_shifts.hpp"
#include "tests/catch.hpp"

using namespace rollres;
using Catch::Matchers::Contains;

namespace {

double true_vertical(double temperature, double strength) { return std::pow(293.15 / temperature, strength); }

/// Rows at 6 temperatures with 2 % noise, whose moduli are divided by b_T = (T0/T)^strength.
std::vector<MeasuredModulus> scaled_rows(std::uint64_t seed, double strength) {
  constexpr double noise = 0.02;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const FractionalZener material{1e6, 500, 1e-2, 0.45};
  std::vector<MeasuredModulus> data;
  for (int step = 0; step < 6; ++step)
    for (int i = 0; i < 7; ++i) {
      const double temperature = 273.15 + 10 * step, above = temperature - 293.15, omega = std::pow(10, 0.5 * i);
      const double factor = std::pow(10, -12 * above / (90 + above));
      const std::complex<double> modulus =
          complex_modulus(material, omega * factor) / true_vertical(temperature, strength);
      const double storage = modulus.real() * (1 + noise * normal(random)),
                   loss = modulus.imag() * (1 + noise * normal(random));
      data.push_back({.angular_frequency = omega,
                      .temperature = temperature,
                      .storage = storage,
                      .loss = loss,
                      .storage_deviation = noise * storage,
                      .loss_deviation = noise * loss});
    }
  return data;
}

MaterialFit fitted(const std::vector<MeasuredModulus>& data, VerticalShift vertical, MaterialForm form, bool known) {
  MaterialFitOptions options{.form = form, .free_shifts = true, .vertical = vertical, .deviations_known = known};
  options.shift.reference = 293.15;
  options.options.profiles = false;
  return fit_material(data, options);
}

int false_ones(int tables, MaterialForm form, bool known) {
  int taken = 0;
  for (int seed = 1; seed <= tables; ++seed)
    taken += !fitted(scaled_rows(static_cast<std::uint64_t>(seed), 0), VerticalShift::automatic, form, known)
                  .shift.table.moduli.empty();
  return taken;
}

}  // namespace

TEST_CASE("rows without b_T are given none, in forty drawn tables", "[fitting][free_shifts][vertical][long]") {
  // Fails where the least AICc decides: it then takes b_T in some of a hundred tables. (Of 50 each none had one.)
  for (const bool known : {true, false})
    for (const MaterialForm form : {MaterialForm::fractional_zener, MaterialForm::prony}) {
      CAPTURE(known, name_of(form));
      CHECK(false_ones(10, form, known) == 0);
    }
}

TEST_CASE("rows without b_T are given none by a series", "[fitting][free_shifts][vertical]") {
  CHECK(false_ones(2, MaterialForm::prony, true) == 0);
}

TEST_CASE("b_T of drawn rows are found where the data ask, with the errors that they say",
          "[fitting][free_shifts][vertical]") {
  constexpr double strength = 2;
  int inside = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const MaterialFit found =
        fitted(scaled_rows(seed, strength), VerticalShift::automatic, MaterialForm::fractional_zener, true);
    REQUIRE(found.shift.table.moduli.size() == 6);
    CHECK_THAT(found.notes.front(), Contains("times b_T: with them AICc falls by "));
    for (const FittedParameter& one : found.report.parameters) {
      if (!one.parameter.name.starts_with("log10_b_T (")) continue;
      const double temperature = 273.15 + std::stod(one.parameter.name.substr(11));
      const double truth = std::log10(true_vertical(temperature, strength));
      ++all;
      inside += truth >= one.linear.lowest && truth <= one.linear.highest;
    }
  }
  CHECK(all == 20);
  CHECK(inside >= 16);  // 19 are wanted; fewer than 16 have a chance of 3e-3
}

TEST_CASE("vertical shifts are fitted where they are asked for, and not where they are excluded",
          "[fitting][free_shifts][vertical]") {
  const auto data = scaled_rows(1, 0);
  const MaterialFit free = fitted(data, VerticalShift::free, MaterialForm::fractional_zener, true);
  REQUIRE(free.shift.table.moduli.size() == 6);
  for (const double factor : free.shift.table.moduli) CHECK(factor == Approx(1).epsilon(0.1));
  CHECK_THAT(free.notes.front(), Contains("AICc rises by") || Contains("the data ask for them from a fall of 10"));
  const MaterialFit none = fitted(scaled_rows(1, 2), VerticalShift::none, MaterialForm::fractional_zener, true);
  CHECK(none.shift.table.moduli.empty());
}
