#include "fitting/material/free_shifts.hpp"

#include <cmath>
#include <random>

#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"

using namespace rollres;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

const TemperatureShift true_law{.law = ShiftLaw::wlf, .reference = 293.15, .c1 = 12, .c2 = 90};

double true_log_shift(double temperature) {
  const double above = temperature - true_law.reference;
  return -true_law.c1 * above / (true_law.c2 + above);
}

/// Rows as an instrument has them: each temperature missed by some tenths of a kelvin, three decades of frequency.
/// @param series  in place of a fractional solid
std::vector<MeasuredModulus> raw_rows(std::uint64_t seed, double noise = 0.02, double vertical = 0,
                                      const PronySeries* series = nullptr) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const FractionalZener material{1e6, 500, 1e-2, 0.45};
  std::vector<MeasuredModulus> data;
  for (int step = 0; step < 12; ++step)
    for (int i = 0; i < 7; ++i) {
      const double temperature = 253.15 + 7 * step + 0.1 * normal(random), omega = std::pow(10, 0.5 * i);
      const double factor = std::pow(10, true_log_shift(temperature));
      const std::complex<double> modulus =
          (series ? complex_modulus(*series, omega * factor) : complex_modulus(material, omega * factor)) *
          (1 + vertical * step);
      const double storage = modulus.real() * (1 + noise * normal(random)),
                   loss = modulus.imag() * (1 + noise * normal(random));
      data.push_back({.angular_frequency = omega,
                      .temperature = temperature,
                      .storage = storage,
                      .loss = loss,
                      .storage_deviation = noise > 0 ? noise * storage : storage,
                      .loss_deviation = noise > 0 ? noise * loss : loss});
    }
  return data;
}

/// Parameters that are shifts, within their intervals; the reference is one of the temperatures.
std::pair<int, int> held(const MaterialFit& found, double reference) {
  int count = 0, inside = 0;
  for (const FittedParameter& fitted : found.report.parameters) {
    const std::string& name = fitted.parameter.name;
    if (!name.starts_with("log10_a_T (")) continue;
    const double temperature = 273.15 + std::stod(name.substr(name.find('(') + 1));
    const double truth = true_log_shift(temperature) - true_log_shift(reference);
    ++count;
    inside += truth >= fitted.linear.lowest && truth <= fitted.linear.highest ? 1 : 0;
  }
  return {inside, count};
}

}  // namespace

TEST_CASE("free shifts of drawn rows hold the truth as often as they say, for a series and for a fractional solid",
          "[fitting][free_shifts][long]") {
  for (const MaterialForm form : {MaterialForm::prony, MaterialForm::fractional_zener}) {
    int inside = 0, all = 0;
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      const auto data = raw_rows(seed);
      MaterialFitOptions options{.form = form, .free_shifts = true, .deviations_known = true};
      options.shift.reference = steps_of_temperature(data)[6];
      options.options.profiles = false;
      const MaterialFit found = fit_material(data, options);
      CHECK(found.report.relative_rms < 0.03);
      const auto [these, count] = held(found, options.shift.reference);
      REQUIRE(count == 11);
      inside += these;
      all += count;
    }
    CAPTURE(name_of(form), inside, all);
    CHECK(inside >= 0.85 * all);  // 95 % are wanted; a binomial of 88 has fewer with 3e-4
  }
}

// Fails if the series' times stay in even steps, which hold shifts to places where ripples meet: of a spectrum with a
// time for each decade 55 % were inside then, of five times 18 %, and b_T was called for.
TEST_CASE("free shifts hold the truth of spectra with few times, too, and no b_T is called for",
          "[fitting][free_shifts][long]") {
  PronySeries decades{1e6, {}};
  for (int i = 0; i < 9; ++i) decades.terms.push_back({1.5e8 * std::pow(0.55, i), 1e-6 * std::pow(10, i)});
  const PronySeries five{1e6, {{3e8, 2.3e-6}, {1e8, 1.1e-4}, {3e7, 8e-3}, {5e6, 0.6}, {1e6, 91}}};
  for (const PronySeries& truth : {decades, five})
    for (const bool deviations_known : {false, true}) {
      int inside = 0, all = 0;
      for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        const auto data = raw_rows(seed, 0.02, 0, &truth);
        MaterialFitOptions options{
            .form = MaterialForm::prony, .free_shifts = true, .deviations_known = deviations_known};
        options.shift.reference = steps_of_temperature(data)[6];
        options.options.profiles = false;
        const MaterialFit found = fit_material(data, options);
        CHECK(found.shift.table.moduli.empty());
        CHECK(superposition_test(data, steps_of_temperature(data)).holds());
        const auto [these, count] = held(found, options.shift.reference);
        inside += these;
        all += count;
      }
      CAPTURE(truth.terms.size(), deviations_known, inside, all);
      CHECK(inside >= 0.85 * all);
    }
}

TEST_CASE("exact rows give their law of shift back, and it is named", "[fitting][free_shifts]") {
  const auto data = raw_rows(5, 0);
  MaterialFitOptions options{.form = MaterialForm::fractional_zener, .free_shifts = true};
  options.options.profiles = false;
  const MaterialFit found = fit_material(data, options);
  REQUIRE(found.shift.table.temperatures.size() == 12);
  for (const double temperature : {255.0, 270.0, 300.0, 325.0})
    CHECK(std::log10(shift_factor(found.shift, temperature)) == Approx(true_log_shift(temperature)).margin(5e-3));
  CHECK_THAT(found.notes.front(), Contains("vertical shifts b_T are left out: with them AICc would rise by"));
  CHECK_THAT(found.notes[1], Contains("WLF through the shifts (wlf_c1 = 12") && Contains("wlf_c2 = 90"));
  CHECK_THAT(found.notes.back(), Contains("time-temperature superposition holds"));
}

TEST_CASE("moduli that no shift of frequencies joins are said to break superposition", "[fitting][free_shifts]") {
  const auto data = raw_rows(5, 0), scaled = raw_rows(5, 0, 0.3);
  const std::vector<double> steps = steps_of_temperature(data);
  CHECK(superposition_test(data, steps).holds());
  CHECK(superposition_test(data, steps).rms < 0.5);
  const SuperpositionTest broken = superposition_test(scaled, steps);
  CHECK_FALSE(broken.holds());
  CHECK_THAT(broken.in_words(), Contains("superposition does not hold"));
}

TEST_CASE("temperatures without overlap are named, and those without steps refused", "[fitting][free_shifts]") {
  auto data = raw_rows(5, 0);
  std::erase_if(data, [](const MeasuredModulus& row) { return row.angular_frequency > 2; });
  TemperatureShift table{.law = ShiftLaw::table, .reference = 293.15};
  table.table.temperatures = steps_of_temperature(data);
  for (const double temperature : table.table.temperatures)
    table.table.factors.push_back(shift_factor(true_law, temperature));
  CHECK_THAT(without_overlap(data, table), StartsWith("reduced frequencies do not overlap between -20"));
  CHECK(without_overlap(raw_rows(5, 0), table).empty());

  std::vector<MeasuredModulus> drifting = data;
  for (std::size_t i = 0; i < drifting.size(); ++i) drifting[i].temperature = 273.15 + 0.7 * static_cast<double>(i);
  drifting[3].place = "raw.csv, line 5";
  CHECK_THAT(message_of([&] { steps_of_temperature(drifting); }),
             StartsWith("raw.csv, line 5: temperature = 2.1 degC") && Contains("from 0 degC they run on"));
  for (MeasuredModulus& row : drifting) row.temperature = 300;
  CHECK_THAT(message_of([&] { steps_of_temperature(drifting); }), Contains("two temperatures at least"));
}
