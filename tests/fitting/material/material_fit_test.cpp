#include "fitting/material/material_fit.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include "core/algebra/dense_algebra.hpp"
#include "core/material/material.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"

using namespace rollres;

namespace {

/// Moduli with a relative error, at frequencies from 1e-3 to 1e5 rad/s.
template <class Material>
std::vector<MeasuredModulus> measured_moduli(const Material& material, double noise,
                                             const std::vector<double>& temperatures = {293.15},
                                             const TemperatureShift& shift = {}) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::vector<MeasuredModulus> data;
  for (const double temperature : temperatures)
    for (int i = 0; i < 25; ++i) {
      const double omega = std::pow(10, -3 + i / 3.0);
      const auto modulus = complex_modulus(material, omega * shift_factor(shift, temperature));
      const double storage = modulus.real() * (1 + noise * normal(random));
      const double loss = modulus.imag() * (1 + noise * normal(random));
      data.push_back({omega, temperature, storage, loss, 0.02 * storage, 0.02 * loss});
    }
  return data;
}

}  // namespace

TEST_CASE("a fractional Zener solid of order 1 and a Prony series of one term are Zener solids", "[core][material]") {
  const RollingScene scene = plain_scene();
  const double g0 = *scene.static_shear_modulus, f = scene.stiffening, tau = scene.creep_time;
  for (const double omega : {-3.0, 0.01, 1.0, 30.0, 1e4}) {
    const auto zener = complex_modulus(scene, omega);
    CHECK(std::abs(complex_modulus(FractionalZener{g0, f, tau, 1}, omega) - zener) < 1e-14 * std::abs(zener));
    CHECK(std::abs(complex_modulus(PronySeries{g0, {{f * g0, tau / (1 + f)}}}, omega) - zener) <
          1e-14 * std::abs(zener));
  }
}

TEST_CASE("temperature shifts are 1 at the reference and follow their laws", "[core][material]") {
  const TemperatureShift wlf{ShiftLaw::wlf, 293.15, 8.86, 101.6, 0};
  CHECK(shift_factor(wlf, 293.15) == 1);
  CHECK(shift_factor(wlf, 313.15) == Approx(std::pow(10, -8.86 * 20 / 121.6)));
  CHECK_THAT(message_of([&] { shift_factor(wlf, 150); }), Catch::Contains("above the reference"));
  const TemperatureShift arrhenius{ShiftLaw::arrhenius, 300, 0, 0, 8.31446261815324e4};
  CHECK(shift_factor(arrhenius, 250) == Approx(std::exp(1e4 * (1 / 250.0 - 1 / 300.0))));
}

TEST_CASE("non-negative least squares obey the conditions of Kuhn and Tucker", "[fitting][material_fit]") {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::MatrixXd a = Eigen::MatrixXd::NullaryExpr(12, 6, [&] { return normal(random); });
    const Eigen::VectorXd b = Eigen::VectorXd::NullaryExpr(12, [&] { return normal(random); });
    const Eigen::VectorXd x = nonnegative_least_squares(a, b), gradient = a.transpose() * (b - a * x);
    for (Eigen::Index j = 0; j < 6; ++j) {
      CHECK(x[j] >= 0);
      CHECK(gradient[j] < 1e-10);
      CHECK(std::abs(x[j] * gradient[j]) < 1e-10);
    }
  }
}

TEST_CASE("moduli of a fractional Zener solid give it back, with a WLF shift", "[fitting][material_fit][long]") {
  const FractionalZener truth{1e6, 300, 2, 0.5};
  const TemperatureShift shift{ShiftLaw::wlf, 293.15, 8.86, 101.6, 0};
  const auto data = measured_moduli(truth, 0.02, {273.15, 293.15, 313.15}, shift);
  const MaterialFit found = fit_material(
      data,
      {.form = MaterialForm::fractional_zener, .shift = {ShiftLaw::wlf, 293.15, 5, 60, 0}, .deviations_known = true});
  CHECK(found.report.status >= FitStatus::usable_with_warnings);
  const double values[] = {1e6, 300, 2, 0.5, 8.86, 101.6};
  for (std::size_t j = 0; j < 6; ++j)
    CHECK(std::abs(found.report.parameters[j].value - values[j]) < 3.5 * found.report.parameters[j].standard_error);
  CHECK(std::abs(found.shift.c1 / 8.86 - 1) < 0.05);
}

TEST_CASE("a Prony series with a number of terms of its own follows a fractional solid to the noise",
          "[fitting][material_fit][long]") {
  const FractionalZener truth{1e6, 300, 2, 0.5};
  const auto data = measured_moduli(truth, 0.01);
  const MaterialFit found = fit_material(data, {.options = {.profiles = false}});
  CHECK(found.prony.terms.size() >= 6);
  CHECK(found.prony.terms.size() <= 20);
  CHECK(found.report.relative_rms < 0.05);
  for (const double omega : {0.01, 1.0, 100.0, 1e4}) {
    const auto exact = complex_modulus(truth, omega);
    CHECK(std::abs(found.modulus(omega, 293.15) - exact) < 0.05 * std::abs(exact));
  }
  CHECK(fit_material(data, {.terms = 5, .options = {.profiles = false}}).prony.terms.size() <= 5);
}

TEST_CASE("an automatic Prony series has intervals that close or end at 0, and a true band",
          "[fitting][material_fit]") {
  auto data = measured_moduli(FractionalZener{1e6, 300, 2, 0.5}, 0.02);
  const MaterialFit found = fit_material(data, {.deviations_known = true});
  INFO(name_of(found.report.status) << ": " << found.report.reason);
  CHECK(found.report.status >= FitStatus::usable_with_warnings);
  for (const FittedParameter& fitted : found.report.parameters) CHECK(!fitted.profile.interval.open());
  for (const std::size_t i : {0, 7, 24}) {
    const auto error = found.modulus_error(data[i].angular_frequency, data[i].temperature);
    CHECK(error.real() == Approx(found.report.values[2 * i].band).epsilon(1e-3));
    CHECK(error.imag() == Approx(found.report.values[2 * i + 1].band).epsilon(1e-3));
  }
}

TEST_CASE("moduli at one frequency are too few for a material", "[fitting][material_fit]") {
  const MeasuredModulus one{1, 293.15, 2e6, 1e5, 2e6, 1e5};
  CHECK_THAT(message_of([&] {
               fit_material({one, one, one}, {.form = MaterialForm::zener});
             }),
             Catch::Contains("all at one frequency"));
}

TEST_CASE("a Zener solid's moduli at two temperatures give it back with Arrhenius' energy", "[fitting][material_fit]") {
  const FractionalZener truth{2e6, 3, 0.1, 1};
  const TemperatureShift shift{ShiftLaw::arrhenius, 293.15, 0, 0, 9e4};
  const auto data = measured_moduli(truth, 0, {283.15, 303.15}, shift);
  const MaterialFit found = fit_material(
      data,
      {.form = MaterialForm::zener, .shift = {ShiftLaw::arrhenius, 293.15, 0, 0, 5e4}, .options = {.profiles = false}});
  CHECK(found.zener.static_modulus == Approx(2e6).epsilon(1e-4));
  CHECK(found.zener.stiffening == Approx(3).epsilon(1e-4));
  CHECK(found.zener.creep_time == Approx(0.1).epsilon(1e-4));
  CHECK(found.shift.activation_energy == Approx(9e4).epsilon(1e-4));
}

TEST_CASE("a Zener solid is found from moduli at several temperatures whatever its time and its shift",
          "[fitting][material_fit][long]") {
  const TemperatureShift wlf{ShiftLaw::wlf, 293.15, 12, 80, 0};
  const TemperatureShift vft{.law = ShiftLaw::vft, .reference = 293.15, .vft_b = 900, .vft_temperature = 230};
  TemperatureShift table{.law = ShiftLaw::table, .reference = 293.15};
  for (const double temperature : {263.15, 278.15, 293.15}) {
    table.table.temperatures.push_back(temperature);
    table.table.factors.push_back(shift_factor(wlf, temperature));
  }
  for (const TemperatureShift& shift : {wlf, vft, table})
    for (const double time : {1e-6, 1e-2, 10.0}) {
      CAPTURE(static_cast<int>(shift.law), time);
      const auto data = measured_moduli(FractionalZener{1e6, 20, time, 1}, 0, {263.15, 278.15, 293.15}, shift);
      MaterialFitOptions options{.form = MaterialForm::zener};
      options.shift = shift.law == ShiftLaw::table ? table : TemperatureShift{.law = shift.law};
      options.options.profiles = false;
      const MaterialFit found = fit_material(data, options);
      CHECK(found.zener.static_modulus == Approx(1e6).epsilon(1e-4));
      CHECK(found.zener.stiffening == Approx(20).epsilon(1e-4));
      CHECK(found.zener.creep_time == Approx(time).epsilon(1e-4));
    }
  // Colder than the constants that are usual allow.
  const TemperatureShift cold{ShiftLaw::wlf, 293.15, 5, 200, 0};
  const auto data = measured_moduli(FractionalZener{1e6, 20, 0.1, 1}, 0, {153.15, 223.15, 293.15}, cold);
  for (const ShiftLaw law : {ShiftLaw::wlf, ShiftLaw::vft}) {
    MaterialFitOptions options{.form = MaterialForm::zener};
    options.deviations_known = true;
    options.shift.law = law;
    const MaterialFit found = fit_material(data, options);
    const double error = found.report.parameters[2].standard_error;  // of which a descent may leave a tenth
    CHECK(error < 0.02);
    CHECK(std::abs(found.zener.creep_time - 0.1) < 0.1 * error);
  }
}
