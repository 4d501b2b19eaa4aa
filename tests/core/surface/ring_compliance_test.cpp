#include "core/surface/ring_compliance.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <array>
#include <cmath>

#include "core/surface/layer_compliance.hpp"
#include "tests/catch.hpp"

using namespace rollres;

namespace {

using complex = std::complex<double>;

MediumLayer ring(double thickness, double poisson_ratio, double radius) {
  return {thickness, poisson_ratio, 0, {.instantaneous = 1, .terms = {}}, radius};
}

SurfaceCompliance compliance(const LayeredMedium& rings, double n) {
  const std::vector<complex> moduli(rings.size(), 1.0);
  return ring_compliance(rings, moduli, n / rings.front().radius);
}

/// A ring on a rigid core by Michell's stress functions r^n, r^-n, r^(n+2), r^(2-n), n >= 2: displacements u_r, u_phi
/// over the tractions on r = 1, [displacement, traction] of unit modulus.
Eigen::Matrix2d by_stress_functions(double n, double core, double poisson_ratio) {
  const double kappa = 3 - 4 * poisson_ratio;
  const auto columns = [&](double r) {
    Eigen::Matrix4d c;  // rows 2G u_r, 2G u_phi, sigma_rr, sigma_rphi
    const auto put = [&](int column, double power, double ur, double ut, double normal, double shear) {
      const double size = std::pow(r, power);
      c.col(column) << ur * size * r, ut * size * r, normal * size, shear * size;
    };
    put(0, n - 2, -n, n, n * (1 - n), n * (n - 1));
    put(1, -n - 2, n, n, -n * (n + 1), -n * (n + 1));
    put(2, n, kappa - 1 - n, kappa + 1 + n, 2 + n - n * n, n * (n + 1));
    put(3, -n, kappa - 1 + n, -(kappa + 1 - n), 2 - n - n * n, n * (1 - n));
    return c;
  };
  const Eigen::Matrix4d inside = columns(core), face = columns(1);
  Eigen::Matrix4d system;
  system << inside.topRows<2>(), face.bottomRows<2>();
  Eigen::Matrix<double, 4, 2> right = Eigen::Matrix<double, 4, 2>::Zero();
  right(2, 0) = right(3, 1) = 1;
  return 0.5 * face.topRows<2>() * system.fullPivLu().solve(right);
}

}  // namespace

TEST_CASE("a ring answers harmonic by harmonic as Michell's stress functions say", "[core][ring_compliance]") {
  for (const double poisson_ratio : {0.0, 0.3, 0.5})
    for (const double core : {0.2, 0.76, 0.95})
      for (const double n : {2.0, 3.5, 9.0, 20.0}) {
        CAPTURE(poisson_ratio, core, n);
        const SurfaceCompliance c = compliance({ring(1 - core, poisson_ratio, 1)}, n);
        const Eigen::Matrix2d exact = by_stress_functions(n, core, poisson_ratio);
        CHECK(c.normal.real() == Approx(exact(0, 0)).epsilon(1e-9));
        CHECK(n * c.longitudinal.real() == Approx(n * exact(1, 1) + exact(0, 1)).epsilon(1e-9));
        CHECK(-n * c.cross.real() == Approx(n * exact(1, 0) + exact(0, 0)).margin(1e-9 * exact(0, 0)));
        CHECK(-(c.cross + c.hoop).real() == Approx(exact(0, 1)).margin(1e-9 * exact(0, 0)));
      }
}

TEST_CASE("harmonics 0 and 1 of a ring are limits like any others", "[core][ring_compliance]") {
  for (const double poisson_ratio : {0.2, 0.5})
    for (const double n : {1.0, 2.0}) {
      const LayeredMedium cover{ring(0.4, poisson_ratio, 1)};
      const double below = compliance(cover, n - 1e-4).normal.real(), above = compliance(cover, n + 1e-4).normal.real();
      CHECK(compliance(cover, n).normal.real() == Approx(0.5 * (below + above)).epsilon(1e-6));
    }
  // Lame's ring under uniform pressure: u = (1 - 2 nu)(1 - b^2)/(2 G (1 + (1 - 2 nu) b^2)).
  const double b2 = 0.36, give = 1 - 2 * 0.2;
  CHECK(compliance({ring(0.4, 0.2, 1)}, 1e-7).normal.real() ==
        Approx(give * (1 - b2) / (2 * (1 + give * b2))).epsilon(1e-6));
}

TEST_CASE("a ring cut in two, or in five, is the same ring", "[core][ring_compliance]") {
  for (const double poisson_ratio : {0.3, 0.5})
    for (const double n : {0.3, 1.0, 4.0, 40.0}) {
      const SurfaceCompliance whole = compliance({ring(0.3, poisson_ratio, 1)}, n);
      LayeredMedium parts;
      for (int i = 0; i < 5; ++i) parts.push_back(ring(0.06, poisson_ratio, 1 - 0.06 * i));
      for (const LayeredMedium& cut :
           {LayeredMedium{ring(0.1, poisson_ratio, 1), ring(0.2, poisson_ratio, 0.9)}, parts}) {
        const SurfaceCompliance c = compliance(cut, n);
        CHECK(std::abs(c.normal - whole.normal) < 1e-11 * std::abs(whole.longitudinal));
        CHECK(std::abs(c.longitudinal - whole.longitudinal) < 1e-11 * std::abs(whole.longitudinal));
        CHECK(std::abs(c.cross - whole.cross) < 1e-11 * std::abs(whole.longitudinal));
        CHECK(std::abs(c.hoop - whole.hoop) < 1e-11 * std::abs(whole.longitudinal));
      }
    }
}

TEST_CASE("a thin ring is a flat layer", "[core][ring_compliance]") {
  for (const double poisson_ratio : {0.3, 0.5})
    for (const double h : {0.1, 1.0, 5.0}) {  // wavenumber times thickness
      const double thickness = 1e-6, k = h / thickness;
      const SurfaceCompliance c = compliance({ring(thickness, poisson_ratio, 1)}, k);
      const LayerSymbols flat = layer_symbols(k, {thickness, poisson_ratio});
      CHECK(c.normal.real() == Approx(flat.normal).epsilon(2e-5));  // they differ by some H/R
      CHECK(c.longitudinal.real() == Approx(flat.longitudinal).epsilon(2e-5));
      CHECK(c.cross.real() == Approx(flat.cross).margin(2e-5 * flat.longitudinal));
    }
}
