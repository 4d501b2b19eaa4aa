#include "core/material/prony_series.hpp"

#include "tests/catch.hpp"

using namespace rollres;

namespace {

std::complex<double> modulus(const RelaxationSpectrum& spectrum, double omega) {
  std::complex<double> sum = spectrum.instantaneous;
  for (const RelaxationSpectrum::Term& term : spectrum.terms)
    sum -= term.modulus / std::complex<double>(1, omega * term.time);
  return sum;
}

}  // namespace

TEST_CASE("a relaxation spectrum is the inverse of the creep spectrum at any frequency", "[core][relaxation]") {
  std::vector<CreepSpectrum> spectra = {
      {1e-7, {{3e-7, 0.25}}},
      {1e-8, {{1e-10, 1e-6}, {5e-8, 1e-3}, {2e-7, 0.2}, {1e-9, 0.21}, {7e-7, 1e4}}},
      {2e-7, {{1e-12, 1}, {1e-6, 1.001}, {1e-12, 1e8}}},
  };
  // Two times as near to each other as those of a layer and of its coating may come.
  for (double apart = 0.5; apart > 1e-6; apart *= 0.83)
    spectra.push_back({3e-9, {{1.7e-8, 0.09578565 * (1 - apart)}, {2e-9, 0.09578565}}});
  for (const CreepSpectrum& creep : spectra) {
    const RelaxationSpectrum relaxation = relaxation_spectrum(creep);
    REQUIRE(relaxation.terms.size() == creep.terms.size());
    for (std::size_t m = 0; m < creep.terms.size(); ++m) {
      CHECK(relaxation.terms[m].time < creep.terms[m].time);
      CHECK(relaxation.terms[m].modulus > 0);
    }
    for (double omega = 1e-9; omega < 1e9; omega *= 7) {
      CAPTURE(omega);
      CHECK(std::abs(modulus(relaxation, omega) * creep(omega) - 1.0) < 1e-11);
    }
  }
}
