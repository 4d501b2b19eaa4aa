// Covers material_inputs and material_scale.

#include <algorithm>
#include <cmath>

#include "core/material/fractional_zener.hpp"
#include "core/material/lumped_spectrum.hpp"
#include "core/material/material_functions.hpp"
#include "core/material/prony_series.hpp"
#include "core/messages/message_text.hpp"
#include "core/messages/number_list.hpp"
#include "core/model/scene_rules.hpp"
#include "core/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/core/material/wide_series.hpp"
#include "tests/core/paper_scenes.hpp"
#include "tests/core/rubber.hpp"

using namespace rollres;
using Catch::Matchers::Contains;

namespace {

/// max |J_a/J_b - 1| of two compliances.
template <class A, class B>
double largest_difference(A&& a, B&& b, double from, double to) {
  double largest = 0;
  for (double omega = from; omega < to; omega *= 1.37) largest = std::max(largest, std::abs(a(omega) / b(omega) - 1.0));
  return largest;
}

}  // namespace

TEST_CASE("a Prony series and its spectrum of creep are each other's inverse, over twelve decades",
          "[core][material]") {
  for (const int terms : {2, 9, 27, 81}) {
    CAPTURE(terms);
    const PronySeries series = wide_series(terms);
    const CreepSpectrum creep = creep_spectrum(series);
    REQUIRE(std::ssize(creep.terms) == terms);
    CHECK(creep.at_rest() == Approx(1e-6).epsilon(1e-13));
    const auto exact = [&](double omega) { return 1.0 / complex_modulus(series, omega); };
    CHECK(largest_difference(creep, exact, 1e-6, 1e12) < 1e-12);
    const RelaxationSpectrum back = relaxation_spectrum(creep);
    for (std::size_t j = 0; j < series.terms.size(); ++j) {
      CHECK(creep.terms[j].time > series.terms[j].time);
      CHECK(back.terms[j].time == Approx(series.terms[j].time).epsilon(1e-11));
      CHECK(back.terms[j].modulus == Approx(series.terms[j].modulus).epsilon(1e-9));
    }
  }
}

TEST_CASE("a Prony series whose times nearly coincide has the creep of one with them as one", "[core][material]") {
  const CreepSpectrum one = creep_spectrum(PronySeries{1e6, {{2e6, 1e-3}, {3e6, 1}}});
  for (const double apart : {1e-3, 1e-8, 1e-12, 1e-15}) {
    CAPTURE(apart);
    const CreepSpectrum two = creep_spectrum(PronySeries{1e6, {{1e6, 1e-3}, {1e6, 1e-3 * (1 + apart)}, {3e6, 1}}});
    REQUIRE(two.terms.size() == 3);
    CHECK(largest_difference(one, two, 1e-3, 1e6) < 1e-13 + apart);
  }
}

TEST_CASE("a term far weaker than all others leaves a Prony series' creep as it was, at whatever time it is",
          "[core][material]") {
  // The modulus hardly turns at the weak term's pole: a search of zeros that settles there loses a strong neighbour.
  const PronySeries series = wide_series(17);
  for (double weak = 1e-13; weak > 1e-18; weak /= 30)
    for (int n = 0; n <= 60; ++n) {
      PronySeries more = series;
      more.terms.push_back({weak * 1e6, 3e-9 * std::pow(10.0, 12.0 * n / 60)});
      const CreepSpectrum creep = creep_spectrum(ordered(more));
      for (double omega = 1e-5; omega < 1e11; omega *= 30) {
        CAPTURE(weak, n, omega);
        CHECK(std::abs(complex_modulus(series, omega) * creep(omega) - 1.0) < 1e-12);
      }
    }
}

TEST_CASE("the order of a Prony series' terms, equal times and moduli that are zero make no difference",
          "[core][material]") {
  MaterialInputs layer;
  layer.material = MaterialModel::prony;
  layer.static_shear_modulus = 2e6;
  layer.relaxation_times = {1e-3, 1};
  layer.relaxation_moduli = {1e6, 3e6};
  MaterialInputs mixed = layer;
  mixed.relaxation_times = {1, 7, 1e-3, 1};
  mixed.relaxation_moduli = {2e6, 0, 1e6, 1e6};
  CHECK(largest_difference(creep_spectrum(layer), creep_spectrum(mixed), 1e-3, 1e6) < 1e-14);
}

TEST_CASE("the spectrum of a fractional Zener solid meets its modulus to 1e-7 of the compliance at rest, for any order",
          "[core][material]") {
  for (const double order : {0.2, 0.5, 0.8, 0.95, 0.999, 1 - 1e-6, 1 - 1e-12, 1.0}) {
    CAPTURE(order);
    const FractionalZener solid{2e6, 9, 0.1, order};
    const CreepSpectrum creep = creep_spectrum(solid);
    CHECK(creep.at_rest() == Approx(0.5e-6).epsilon(1e-13));
    for (double omega = 1e-8; omega < 1e10; omega *= 2.3)
      CHECK(std::abs(creep(omega) - 1.0 / complex_modulus(solid, omega)) < 1e-7 / 2e6);
    for (const CreepSpectrum::Term& term : creep.terms) CHECK(term.compliance > 0);
    CHECK(creep.terms.size() < 200);
  }
  CHECK(creep_spectrum(FractionalZener{2e6, 9, 0.1, 1}).terms.size() == 1);
}

TEST_CASE("Young's modulus E is 2 (1 + ν) G, at rest and in lists", "[core][material]") {
  MaterialInputs shear;
  shear.material = MaterialModel::prony;
  shear.poisson_ratio = 0.4;
  shear.static_shear_modulus = 1e6;
  shear.relaxation_times = {1e-3, 1};
  shear.relaxation_moduli = {1e6, 3e6};
  MaterialInputs young = shear;
  young.static_shear_modulus.reset();
  young.static_young_modulus = 2.8e6;
  young.listed_moduli = ListedModuli::young;
  young.relaxation_moduli = {2.8e6, 8.4e6};
  CHECK(largest_difference(creep_spectrum(shear), creep_spectrum(young), 1e-3, 1e6) < 1e-14);
  CHECK(static_modulus(young) == Approx(1e6).epsilon(1e-15));
}

TEST_CASE("a temperature shifts all times by the shift law", "[core][material]") {
  MaterialInputs layer = filled_rubber();
  layer.reference_temperature = 293.15;
  layer.wlf_c1 = 4.41;
  layer.wlf_c2 = 137.64;
  CreepSpectrum at_reference = creep_spectrum(layer);
  layer.temperature = 253.15;
  const double shift = std::pow(10, 4.41 * 40 / (137.64 - 40));
  const auto shifted = [&](double omega) { return at_reference(shift * omega); };
  CHECK(largest_difference(creep_spectrum(layer), shifted, 1e-3, 1e6) < 1e-13);
  CHECK_THAT(material_route(layer), Contains("times at -20 degC: 64.067 of those at 20 degC (WLF)"));
  CHECK(in_celsius(std::nextafter(273.15, 300)) == "0 degC");  // not 5.68e-14
  layer.temperature = layer.reference_temperature;
  CHECK(largest_difference(creep_spectrum(layer), at_reference, 1e-3, 1e6) < 1e-14);

  MaterialInputs zener;
  zener.static_shear_modulus = 1e6;
  zener.stiffening = 2;
  zener.creep_time = 0.1;
  zener.activation_energy = 1e5;
  zener.reference_temperature = 300;
  zener.temperature = 310;
  CHECK(check_material(zener).empty());
  CHECK(creep_spectrum(zener).terms.front().time ==
        Approx(0.1 * std::exp(1e5 / 8.31446261815324 * (1 / 310. - 1 / 300.))).epsilon(1e-14));
}

TEST_CASE("terms too short or too long to tell apart become one, exact to first order", "[core][material]") {
  const CreepSpectrum creep = creep_spectrum(FractionalZener{1e6, 9, 1, 0.5});
  const CreepSpectrum few = lumped(creep, {1e-6, 1e6});
  CHECK(10 * few.terms.size() < 6 * creep.terms.size());
  // Long memories of different lengths count with their logarithms, too.
  const auto logarithms = [](const CreepSpectrum& spectrum) {
    double sum = 0;
    for (const CreepSpectrum::Term& term : spectrum.terms)
      if (term.time > 1e6) sum += term.compliance / term.time * std::log(term.time);
    return sum;
  };
  CHECK(logarithms(few) == Approx(logarithms(creep)).epsilon(1e-13));
  CHECK(largest_difference(few, creep, 1e-3, 1e3) < 1e-6);
  CHECK(lumped(few, {1e-6, 1e6}).terms.size() == few.terms.size());
  // Of a memory without end its rate alone is left.
  const CreepSpectrum unending{.instantaneous = 1, .terms = {{4, 1e12}}};
  const CreepSpectrum ending = lumped(unending, {1e-6, 1e6, 1e10});
  REQUIRE(ending.terms.size() == 1);
  CHECK(ending.terms[0].time == 1e10);
  CHECK(ending.terms[0].compliance == Approx(0.04).epsilon(1e-14));
}

TEST_CASE("a Zener solid creeps and relaxes as it should, and loses most at 1/τ times the root of 1 + f",
          "[core][material]") {
  const double G0 = 2e6, f = 3, tau = 0.1;
  const CreepSpectrum creep = creep_spectrum(FractionalZener{G0, f, tau, 1});
  const RelaxationSpectrum relaxation = relaxation_spectrum(creep);
  for (const double t : {0.0, 1e-3, 0.1, 7.0}) {
    CHECK(creep_compliance(creep, t) == Approx((1 - f / (1 + f) * std::exp(-t / tau)) / G0).epsilon(1e-14));
    CHECK(relaxation_modulus(relaxation, t) == Approx(G0 * (1 + f * std::exp(-t * (1 + f) / tau))).epsilon(1e-13));
  }
  CHECK(slow_loss_time(creep) == Approx(f * tau / (1 + f)).epsilon(1e-14));
  const std::vector<LossPeak> peaks = loss_peaks(creep);
  REQUIRE(peaks.size() == 1);
  CHECK(peaks.front().omega == Approx(std::sqrt(1 + f) / tau).epsilon(1e-6));
  CHECK(peaks.front().tangent == Approx(f / (2 * std::sqrt(1 + f))).epsilon(1e-12));
  CHECK(loss_peaks(creep_spectrum(FractionalZener{G0, 0, tau, 1})).empty());
}

TEST_CASE("a material's inputs that are missing, too many or do not go together are named", "[core][material]") {
  const auto first = [](auto&& change) {
    RollingScene scene = paper_cylinder();
    change(scene);
    const auto broken = check(scene);
    return broken.empty() ? std::string() : broken.front();
  };
  using Scene = RollingScene;
  CHECK(first([](Scene&) {}).empty());
  CHECK(first([](Scene& s) { s.static_young_modulus = 9e6; }) ==
        "static_young_modulus = 9e+06: give static_shear_modulus or static_young_modulus, not both");
  CHECK(first([](Scene& s) { s.static_shear_modulus.reset(); }) ==
        "static_shear_modulus is missing: give static_shear_modulus or static_young_modulus (Pa)");
  CHECK(first([](Scene& s) { s.material = MaterialModel::prony; }) ==
        "relaxation_times is missing: material \"prony\" needs it");
  CHECK(first([](Scene& s) {
          s.material = MaterialModel::prony;
          s.relaxation_times = {1, 2};
          s.relaxation_moduli = {1};
        }) == "relaxation_moduli: has 1 values, but relaxation_times has 2");
  CHECK(first([](Scene& s) { s.relaxation_times = {1, -2}; }) == "relaxation_times[1] = -2: must be > 0");
  CHECK(first([](Scene& s) {
          s = with_material(s, filled_rubber());
          s.loss_moduli[4] = -1;
        }) == "loss_moduli[4] = -1: must be >= 0");
  CHECK(first([](Scene& s) {
          s = with_material(s, filled_rubber());
          s.frequencies.assign(9, 1.0);
        }) == "frequencies: must have at least two different values");
  CHECK(first([](Scene& s) { s.fractional_order = 1.1; }) == "fractional_order = 1.1: must be above 0 and up to 1");
  CHECK(first([](Scene& s) { s.temperature = 300; }) ==
        "temperature = 300: has no effect without a shift law: give wlf_c1 and wlf_c2, activation_energy, vft_b and "
        "vft_temperature, or shift_factors");
  CHECK(first([](Scene& s) { s.wlf_c1 = 8; }) == "wlf_c2 is missing: wlf_c1 and wlf_c2 go together");
  CHECK(first([](Scene& s) {
          s.temperature = 300;
          s.activation_energy = 1e5;
        }) == "reference_temperature is missing: a temperature needs it (K)");
  CHECK(first([](Scene& s) {
          s.wlf_c1 = 8;
          s.wlf_c2 = 50;
          s.activation_energy = 1e5;
        }) ==
        "wlf_c1 and activation_energy: give one law of shift: wlf_c1 and wlf_c2, activation_energy, vft_b and "
        "vft_temperature, or shift_factors");
  CHECK(first([](Scene& s) { s.vft_b = 2000; }) == "vft_temperature is missing: vft_b and vft_temperature go together");
  CHECK(first([](Scene& s) {
          s.vft_b = 2000;
          s.vft_temperature = 200;
          s.reference_temperature = 190;
          s.temperature = 250;
        }) == "reference_temperature = 190: must be above vft_temperature");
  CHECK(first([](Scene& s) {
          s.shift_factors = {1, 2};
        }) == "shift_temperatures is missing: shift_factors needs it (K)");
  CHECK(first([](Scene& s) {
          s.shift_temperatures = {280, 300, 320};
          s.modulus_shifts = {1, 2};
        }) == "modulus_shifts: has 2 values, but shift_temperatures has 3");
  CHECK(first([](Scene& s) {
          s.shift_temperatures = {280, 280};
          s.shift_factors = {1, 2};
        }) == "shift_temperatures = 280: given twice");
  CHECK(first([](Scene& s) {
          s.shift_temperatures = {280, 300};
          s.shift_factors = {10, 1};
          s.reference_temperature = 300;
          s.temperature = 278.9;
        }) ==
        "temperature = 278.9: must be within shift_temperatures, 280 to 300 K: beyond its ends the table goes on by "
        "half a step and 1 K at most");
  CHECK(first([](Scene& s) {
          s.shift_temperatures = {280, 300};
          s.shift_factors = {10, 1};
          s.reference_temperature = 300.016;  // as the instrument read it
          s.temperature = 279.1;
        }).empty());
  CHECK(first([](Scene& s) {
          s.wlf_c1 = 8;
          s.wlf_c2 = 50;
          s.reference_temperature = 300;
          s.temperature = 250;
        }) == "temperature = 250: must be above reference_temperature - wlf_c2");
}

TEST_CASE("a list of numbers as text reads back bit by bit, and nothing else does", "[core][quantity]") {
  const std::vector<double> numbers{1.0 / 3, 0.1 + 0.2, 5e-324, 1e17 / 3};
  CHECK(list_in(text_of_list(numbers)) == numbers);
  CHECK(text_of_list({}) == "[]");
  CHECK(list_in("[ 1,2 ]") == std::vector<double>{1, 2});
  CHECK(list_in("[]")->empty());
  for (const char* const wrong : {"", "1", "[1", "[1,]", "[1 2]", "[1] 2", "[nan]", "[inf]", "[x]"})
    CHECK_FALSE(list_in(wrong));
}

TEST_CASE("a Prony series whose creep is beyond all numbers names the term", "[core][material]") {
  CHECK_THROWS_WITH(
      creep_spectrum(PronySeries{1e-200, {{1e-200, 1e-3}, {1e200, 1}}}),
      Catch::Matchers::Contains("relaxation_moduli: no time of creep was found above the relaxation time of 1 s"));
}
