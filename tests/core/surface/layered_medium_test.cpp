/// Surface compliance of layered media (layered_medium, layer_waves) against closed forms, and its expansion in fixed
/// retardation times.

#include "core/surface/layered_medium.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>

#include "core/material/prony_series.hpp"
#include "core/surface/medium_expansion.hpp"
#include "tests/catch.hpp"
#include "tests/infinite.hpp"

using namespace rollres;

namespace {

using complex = std::complex<double>;

CreepSpectrum elastic(double modulus) { return {1 / modulus, {}}; }
CreepSpectrum zener(double modulus, double stiffening, double time) {
  const double glassy = 1 / (modulus * (1 + stiffening));
  return {glassy, {{stiffening * glassy, time}}};
}

double difference(const SurfaceCompliance& a, const SurfaceCompliance& b) {
  return std::max({std::abs(a.normal - b.normal), std::abs(a.longitudinal - b.longitudinal),
                   std::abs(a.cross - b.cross), std::abs(a.transverse - b.transverse)}) /
         std::abs(b.longitudinal);
}

SurfaceCompliance of_layer(double wavenumber, const Layer& layer, complex modulus) {
  const LayerSymbols c = layer_symbols(wavenumber, layer);
  return {c.normal / modulus, c.longitudinal / modulus, c.cross / modulus, c.transverse / modulus};
}

/// An incompressible layer with inertia by its stream function psi, (D^2 - k^2)(D^2 - s^2) psi = 0, psi = psi' = 0 at
/// the base: u = psi', w = -i k psi, tau = G (psi'' + k^2 psi), sigma = (i G/k)(psi''' - (s^2 + 2 k^2) psi').
SurfaceCompliance by_stream_function(double k, double thickness, complex modulus, double density, double speed) {
  const complex s = std::sqrt(k * k - density * speed * speed * k * k / modulus), i(0, 1);
  const double h = k * thickness;
  const complex g = s * thickness;
  // psi_1 = cosh kz - cosh sz, psi_2 = sinh(kz)/k - sinh(sz)/s and their derivatives at the surface
  const complex p[2][4] = {
      {std::cosh(h) - std::cosh(g), k * std::sinh(h) - s * std::sinh(g), k * k * std::cosh(h) - s * s * std::cosh(g),
       k * k * k * std::sinh(h) - s * s * s * std::sinh(g)},
      {std::sinh(h) / k - std::sinh(g) / s, std::cosh(h) - std::cosh(g), k * std::sinh(h) - s * std::sinh(g),
       k * k * std::cosh(h) - s * s * std::cosh(g)}};
  Eigen::Matrix2cd tractions, displacements;  // rows tau, sigma and u, w
  for (int n = 0; n < 2; ++n) {
    tractions(0, n) = modulus * (p[n][2] + k * k * p[n][0]);
    tractions(1, n) = i * modulus / k * (p[n][3] - (s * s + 2 * k * k) * p[n][1]);
    displacements(0, n) = p[n][1];
    displacements(1, n) = -i * k * p[n][0];
  }
  const Eigen::Matrix2cd c = displacements * tractions.inverse();
  // w = c_ww sigma - i c_x tau, u = i c_x sigma + c_ll tau; across: tanh(s H)/(s G)
  return {c(1, 1), c(0, 0), c(0, 1) / i, std::tanh(g) / (s * modulus)};
}

}  // namespace

TEST_CASE("a layer cut into bonded layers of the same material is the layer itself", "[core][layered_medium]") {
  const complex modulus = 1.0 / zener(1e6, 9, 0.01)(-3 / 0.01 * 0.7);
  for (const double nu : {0.0, 0.3, 0.5})
    for (const double h : {0.05, 0.7, 3.0, 40.0}) {
      CAPTURE(nu, h);
      const double thickness = 0.01, k = h / thickness;
      LayeredMedium medium;
      for (const double share : {0.1, 0.25, 0.65}) medium.push_back({share * thickness, nu, 0, zener(1e6, 9, 0.01)});
      const SurfaceCompliance cut = surface_compliance(medium, std::vector<complex>(3, modulus), k, 0);
      // (kH)^-3 digits are lost where the layer is thin against the wave
      CHECK(difference(cut, of_layer(k, {thickness, nu}, modulus)) < 1e-11);
    }
}

TEST_CASE("a layer with inertia has the compliance of its stream function", "[core][layered_medium]") {
  const double density = 1200, thickness = 0.01;
  const CreepSpectrum material = zener(2e6, 4, 1e-3);
  for (const double speed : {1e-3, 3.0, 25.0})
    for (const double h : {0.3, 1.0, 4.0}) {
      CAPTURE(speed, h);
      const double k = h / thickness;
      const complex modulus = 1.0 / material(-k * speed);
      const SurfaceCompliance expected = by_stream_function(k, thickness, modulus, density, speed);
      const SurfaceCompliance got = surface_compliance({{thickness, 0.5, density, material}}, k, 1, speed);
      // The stream functions cancel by rho V^2/G, which is 1e-9 in the slowest case.
      CHECK(difference(got, expected) < (speed < 1 ? 1e-5 : 1e-12));
      const SurfaceCompliance at_rest = surface_compliance({{thickness, 0.5, 0, material}}, k, 1, speed);
      if (speed < 1) CHECK(difference(got, at_rest) < 1e-8);
    }
}

TEST_CASE("a moving line load on a half-space meets the Rayleigh function", "[core][layered_medium]") {
  // w = alpha (1 - beta^2) / (4 alpha beta - (1 + beta^2)^2) / (G k) under unit traction (Cole and Huth 1958)
  const double modulus = 1e6, density = 1000, k = 300;
  for (const double nu : {0.2, 0.5})
    for (const double speed : {1.0, 10.0, 25.0}) {
      CAPTURE(nu, speed);
      const double square = density * speed * speed / modulus, ratio = (1 - 2 * nu) / (2 - 2 * nu);
      const double beta = std::sqrt(1 - square), alpha = std::sqrt(1 - ratio * square);
      const double rayleigh = 4 * alpha * beta - std::pow(1 + beta * beta, 2);
      const SurfaceCompliance c = surface_compliance({{infinite, nu, density, elastic(modulus)}}, k, 1, speed);
      CHECK(c.normal.real() * modulus * k == Approx(alpha * square / rayleigh).epsilon(1e-9));
      CHECK(c.longitudinal.real() * modulus * k == Approx(beta * square / rayleigh).epsilon(1e-9));
    }
}

TEST_CASE("a thick layer on any base is a half-space for short waves", "[core][layered_medium]") {
  const LayeredMedium medium{
      {0.02, 0.45, 0, elastic(1e6)}, {0.01, 0.3, 0, elastic(1e8)}, {infinite, 0.2, 0, elastic(1e4)}};
  const double k = 40 / 0.02;
  const SurfaceCompliance c = surface_compliance(medium, k, 1, 1);
  CHECK(difference(c, of_layer(k, {infinite, 0.45}, 1e6)) < 1e-14);
}

TEST_CASE("a medium of several materials is a sum over fixed retardation times", "[core][medium_expansion]") {
  const LayeredMedium medium{{0.003, 0.5, 0, zener(1e6, 9, 0.01)}, {0.007, 0.4, 0, zener(5e6, 2, 0.3)}};
  const MediumExpansion expansion(medium, 0);
  CHECK(expansion.error() < 1e-5);
  // At a wavenumber and frequencies of its own.
  const double k = 217;
  const MediumExpansion::Corrections correction = expansion.correction(k);
  for (const double omega : {0.013, 3.7, 41.0, 520.0, 9e4}) {
    CAPTURE(omega);
    complex sum = 0;
    for (std::size_t m = 0; m < expansion.terms().size(); ++m)
      sum += (correction(0, static_cast<Eigen::Index>(m)) + expansion.terms()[m].deep.normal) /
             complex(1, omega * expansion.terms()[m].time);
    const complex exact = k * surface_compliance(medium, moduli_at(medium, omega), k, 0).normal;
    CHECK(std::abs(sum - exact) < 2e-5 * std::abs(exact));
  }
}

TEST_CASE("retardation times that are close together do not cancel each other", "[core][medium_expansion]") {
  // Rounding of one time's passage counts by its weight, so that these may not exceed the compliance by far.
  const CreepSpectrum material = creep_spectrum(PronySeries{
      183500, {{149200, 3.645e-06}, {510700, 6.141e-06}, {303600, 6.791e-06}, {71570, 1.731e-05}, {233000, 2.256e-05},
               {333000, 2.741e-05}, {69540, 3.646e-05},  {65810, 5.166e-05},  {25810, 8.738e-05}, {117800, 9.503e-05},
               {163900, 0.000103},  {42160, 0.0001573},  {25460, 0.000203},   {39460, 0.0003513}, {143200, 0.0005314},
               {30730, 0.0005425},  {125200, 0.0006406}, {13430, 0.0008653},  {33000, 0.001032},  {38500, 0.00112},
               {51720, 0.001271},   {14180, 0.001435},   {74810, 0.001586},   {24520, 0.00172},   {35260, 0.001895},
               {10230, 0.003314},   {34880, 0.004807},   {29520, 0.00646},    {8949, 0.007924},   {59990, 0.008521},
               {5411, 0.01764}}});
  const MediumLayer half_space{infinite, 0.5, 1000, material};
  const MediumExpansion expansion({half_space}, 6.452);
  CHECK(expansion.error() < 1e-5);
  double weights = 0;
  for (const MediumTerm& term : expansion.terms()) weights += std::abs(term.deep.normal);
  const double at_rest = half_space_compliance(half_space, 1 / material.at_rest(), 6.452).normal.real();
  CHECK(weights < 50 * at_rest);
}

TEST_CASE("layers of one material share its own retardation times", "[core][medium_expansion]") {
  const CreepSpectrum material = zener(1e6, 9, 0.01);
  const MediumExpansion expansion({{0.004, 0.5, 0, material}, {0.006, 0.5, 0, material}}, 0);
  for (const MediumTerm& term : expansion.terms()) {
    const double expected = term.time == 0                      ? material.instantaneous
                            : std::abs(term.time - 0.01) < 1e-9 ? material.terms[0].compliance
                                                                : 0;
    CHECK(term.deep.transverse == Approx(expected).margin(1e-9 * material.at_rest()));
  }
}
