#include "fitting/material/series_fit.hpp"

#include <cmath>
#include <random>

#include "fitting/material/even_series.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"

// Covers even_series, material_problem and moduli_fit, too.

using namespace rollres;

namespace {

template <class Material>
std::vector<MeasuredModulus> drawn_moduli(const Material& material, double noise, double from, double to, int rows,
                                          std::uint64_t seed = 3) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<MeasuredModulus> data;
  for (int i = 0; i < rows; ++i) {
    const double omega = from * std::pow(to / from, 1.0 * i / (rows - 1));
    const auto modulus = complex_modulus(material, omega);
    const double storage = modulus.real() * (1 + noise * normal(random));
    const double loss = modulus.imag() * (1 + noise * normal(random));
    data.push_back({omega, 293.15, storage, loss, storage, loss});
  }
  return data;
}

}  // namespace

TEST_CASE("relaxation times lie in the middle of even steps over the frequencies", "[fitting][material_fit]") {
  const auto data = drawn_moduli(FractionalZener{1e6, 300, 2, 0.5}, 0, 1e-2, 1e2, 5);
  const std::vector<double> times = even_times(data, {}, 4), wide = even_times(data, {}, 6, 1);
  REQUIRE(times.size() == 4);
  for (std::size_t j = 0; j < 4; ++j) CHECK(times[j] == Approx(std::pow(10, -1.5 + static_cast<double>(j))));
  CHECK(wide.front() == Approx(std::pow(10, -2.5)));
  CHECK(wide.back() == Approx(std::pow(10, 2.5)));
}

TEST_CASE("a wide curve has as many terms as it asks for, found in few evaluations", "[fitting][material_fit][long]") {
  const auto data = drawn_moduli(FractionalZener{1e6, 1000, 1e-3, 0.25}, 0.02, 1e-10, 1e16, 206);
  const MaterialFit found = fit_material(data, {});
  CHECK(found.prony.terms.size() > 20);
  CHECK(found.report.relative_rms < 0.025);
  CHECK(found.report.evaluations < 100);
  CHECK(found.report.status >= FitStatus::usable_with_warnings);
  for (const FittedParameter& fitted : found.report.parameters) {
    CHECK(fitted.linear.lowest >= 0);
    CHECK(!fitted.profile.interval.open());
  }
}

TEST_CASE("a hundred terms cost as few evaluations as ten", "[fitting][material_fit][long]") {
  const auto data = drawn_moduli(FractionalZener{1e6, 1000, 1e-3, 0.25}, 0.02, 1e-10, 1e16, 206);
  for (const int terms : {10, 100}) CHECK(fit_material(data, {.terms = terms}).report.evaluations < 100);
}

TEST_CASE("few terms that are asked for have free times, and come back", "[fitting][material_fit]") {
  const PronySeries truth{1e6, {{2e6, 0.01}, {1e6, 1.0}}};
  const MaterialFit exact = fit_material(drawn_moduli(truth, 0, 1e-2, 1e4, 20), {.terms = 2});
  REQUIRE(exact.prony.terms.size() == 2);
  CHECK(exact.prony.static_modulus == Approx(1e6).epsilon(1e-6));
  for (std::size_t j = 0; j < 2; ++j) {
    CHECK(exact.prony.terms[j].time == Approx(truth.terms[j].time).epsilon(1e-6));
    CHECK(exact.prony.terms[j].modulus == Approx(truth.terms[j].modulus).epsilon(1e-6));
  }
  const MaterialFit even =
      fit_material(drawn_moduli(truth, 0, 1e-2, 1e4, 20), {.terms = 2, .times = SeriesTimes::even});
  CHECK(even.prony.terms[0].time == Approx(std::pow(10, -2.5)));
  CHECK_THAT(message_of([&] { fit_material(drawn_moduli(truth, 0, 1e-2, 1e4, 20), {.times = SeriesTimes::free}); }),
             Catch::Contains("need a number of terms from 1 to 10"));
}

TEST_CASE("intervals of a series' moduli hold the truth as often as they say", "[fitting][material_fit][long]") {
  // Times as the series has them, so that it is the true model; 60 draws of 5 moduli, 95 % of 300.
  const auto frequencies = drawn_moduli(PronySeries{1e6, {{1e6, 1}}}, 0, 1e-2, 1e3, 25);
  PronySeries truth{1e6, {}};
  for (const double time : even_times(frequencies, {}, 4)) truth.terms.push_back({1e6, time});
  int held = 0, all = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const auto data = drawn_moduli(truth, 0.02, 1e-2, 1e3, 25, seed);
    const MaterialFit found = fit_material(data, {.terms = 4, .times = SeriesTimes::even});
    for (std::size_t j = 0; j < found.report.parameters.size(); ++j) {
      const ConfidenceInterval& interval = found.report.parameters[j].profile.interval;
      held += interval.lowest <= 1e6 && interval.highest >= 1e6;
      ++all;
    }
  }
  CHECK(all == 300);
  CHECK(held >= 273);  // three deviations of the binomial distribution below 285
  CHECK(held <= 297);
}

TEST_CASE("moduli that contradict each other are a warning of every fit to them", "[fitting][material_fit]") {
  auto data = drawn_moduli(FractionalZener{1e6, 300, 2, 0.5}, 0.02, 1e-3, 1e5, 40);
  for (MeasuredModulus& row : data) row.storage = 1e6 + (row.storage - 1e6) / 4;
  for (const MaterialForm form : {MaterialForm::prony, MaterialForm::fractional_zener}) {
    const MaterialFit found = fit_material(data, {.form = form, .options = {.profiles = false}});
    CHECK(std::any_of(found.report.warnings.begin(), found.report.warnings.end(), [](const std::string& warning) {
      return warning.starts_with("storage and loss contradict each other");
    }));
  }
}
