#include "core/material/strain_softening.hpp"

#include <cmath>

#include "tests/catch.hpp"
#include "tests/core/rubber.hpp"

using namespace rollres;

namespace {

MaterialInputs kraus() {
  MaterialInputs layer;
  layer.static_shear_modulus = 1e6;
  layer.stiffening = 2;
  layer.creep_time = 0.1;
  layer.payne_drop = 0.5;
  layer.payne_strain = 0.02;
  layer.payne_exponent = 0.5;
  layer.payne_loss_peak = 1.4;
  return layer;
}

}  // namespace

TEST_CASE("Kraus's moduli: half of the drop and the peak of the loss at payne_strain", "[core][material]") {
  const MaterialInputs layer = kraus();
  CHECK(softens(layer));
  CHECK(softening_at(layer, 0).storage == 1);
  CHECK(softening_at(layer, 0.02).storage == Approx(0.75));
  CHECK(softening_at(layer, 0.02).loss == Approx(1.4));
  CHECK(softening_at(layer, 0.04).loss < 1.4);
  CHECK(softening_at(layer, 0.01).loss < 1.4);
  CHECK(softening_at(layer, 1e9).storage == Approx(0.5).epsilon(1e-9));
  MaterialInputs none = layer;
  none.payne_drop = 0;
  none.payne_loss_peak = 1;
  CHECK(!softens(none));
}

TEST_CASE("a strain sweep is met at its rows, in shear and in tension, peak and peak to peak", "[core][material]") {
  MaterialInputs layer = kraus();
  layer.payne_drop = 0;
  layer.payne_loss_peak = 1;
  layer.sweep_strains = {0.001, 0.01, 0.1};
  layer.sweep_storage_moduli = {7.46e6, 5e6, 3.15e6};
  layer.sweep_loss_moduli = {0.825e6, 0.9e6, 0.495e6};
  CHECK(softening_at(layer, 1e-5).storage == 1);
  CHECK(softening_at(layer, 0.01).storage == Approx(5 / 7.46));
  CHECK(softening_at(layer, 0.1).loss == Approx(0.495 / 0.825));
  CHECK(softening_at(layer, 10).storage == Approx(3.15 / 7.46));
  CHECK(*largest_measured_strain(layer) == Approx(0.1));
  layer.sweep_deformation = SweepDeformation::tension;
  layer.sweep_amplitude = SweepAmplitude::peak_to_peak;
  CHECK(softening_at(layer, 0.5 * std::sqrt(3.0) * 0.01).storage == Approx(5 / 7.46));
}

TEST_CASE("the softened material has the wanted moduli at its frequency and relaxes with positive moduli",
          "[core][material]") {
  for (const MaterialInputs& layer : {kraus(), filled_rubber()}) {
    const CreepSpectrum linear = creep_spectrum(layer);
    const double omega = 30;
    const Softening wanted{0.8, 1.1};
    const auto factors = softening_factors(linear, wanted, omega);
    REQUIRE(factors);
    const std::complex<double> before = 1.0 / linear(omega), after = 1.0 / softened(linear, *factors)(omega);
    CHECK(after.real() == Approx(0.8 * before.real()).epsilon(1e-9));
    CHECK(after.imag() == Approx(1.1 * before.imag()).epsilon(1e-9));
    // As the layer's own spectrum with these factors.
    const std::complex<double> own = 1.0 / creep_spectrum(layer, *factors)(2 * omega),
                               same = 1.0 / softened(linear, *factors)(2 * omega);
    CHECK(std::abs(own / same - 1.0) < 1e-9);
    CHECK(static_modulus(layer, *factors) == Approx(factors->rest * static_modulus(layer)).epsilon(1e-9));
  }
}

TEST_CASE("where no positive modulus at rest gives the moduli, there is no linear material", "[core][material]") {
  const CreepSpectrum linear = creep_spectrum(kraus());
  CHECK(!softening_factors(linear, {0.4, 1.2}, 1e3));
  CHECK(softening_factors(linear, {0.4, 0.4}, 1e3));
}

TEST_CASE("an elastic material keeps a modulus alone", "[core][material]") {
  MaterialInputs layer = kraus();
  layer.material = MaterialModel::elastic;
  CHECK(static_modulus(layer, {.rest = 0.7}) == Approx(0.7e6));
  CHECK(creep_spectrum(layer, {.rest = 0.7})(3).real() == Approx(1 / 0.7e6));
}
