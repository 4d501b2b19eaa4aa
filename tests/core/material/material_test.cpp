#include "core/material/material.hpp"

#include <cmath>
#include <complex>

#include "core/reference/reference_solutions.hpp"
#include "tests/catch.hpp"
#include "tests/core/paper_scenes.hpp"

using namespace rollres;

namespace {

RollingScene zener(double stiffening, double creep_time) {
  RollingScene scene = paper_cylinder();
  scene.stiffening = stiffening;
  scene.creep_time = creep_time;
  return scene;
}

}  // namespace

TEST_CASE("the Zener solid has the paper's complex modulus", "[core][material]") {
  const double G0 = 3e6, f = 2.5, tau = 0.04;
  const RollingScene scene = zener(f, tau);
  for (const double omega : {-300.0, -2.0, 1e-3, 1.0, 25.0, 1e4}) {
    const std::complex<double> i_omega_tau(0, omega * tau);
    const std::complex<double> expected = G0 * (1 + f) * (1. + i_omega_tau) / ((1 + f) + i_omega_tau);
    const std::complex<double> got = complex_modulus(scene, omega);
    CHECK(std::abs(got - expected) < 1e-14 * std::abs(expected));
    CHECK(std::abs(complex_modulus(scene, -omega) - std::conj(got)) < 1e-14 * std::abs(got));
    CHECK(std::abs(creep_spectrum(scene)(omega) * got - 1.) < 1e-14);
  }
}

TEST_CASE("the modulus runs from rubbery to glassy, and the loss has the limits of slow and fast motion",
          "[core][material]") {
  const double G0 = 3e6, f = 4, tau = 0.2;
  const RollingScene scene = zener(f, tau);
  // Both limits are approached with the square of omega tau, the losses likewise.
  const std::complex<double> slow = complex_modulus(scene, 1e-6 / tau), fast = complex_modulus(scene, 1e6 / tau);
  CHECK(slow.real() == Approx(G0).epsilon(1e-11));
  CHECK(fast.real() == Approx(G0 * (1 + f)).epsilon(1e-10));
  CHECK(slow.imag() / (1e-6 / tau * slow.real()) == Approx(slow_loss_time(f, tau)).epsilon(1e-10));
  CHECK(fast.real() / (1e6 / tau * fast.imag()) == Approx(fast_loss_time(f, tau)).epsilon(1e-10));
}

TEST_CASE("no stiffening, no creep time and the elastic model are the same elastic material", "[core][material]") {
  RollingScene elastic = zener(3, 0.1);
  elastic.material = MaterialModel::elastic;
  for (const RollingScene& scene : {zener(0, 0.1), zener(3, 0), elastic})
    for (const double omega : {0.0, 1.0, 1e5}) {
      const std::complex<double> modulus = complex_modulus(scene, omega);
      CHECK(modulus.real() == Approx(3e6).epsilon(1e-14));
      CHECK(std::abs(modulus.imag()) < 1e-14 * 3e6);
    }
}
