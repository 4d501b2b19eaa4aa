#include "core/finite_strain/neo_hooke.hpp"

#include <Eigen/LU>
#include <cmath>

#include "tests/catch.hpp"

using namespace rollres;

namespace {

const Eigen::Matrix2d some_gradient = (Eigen::Matrix2d() << 1.3, 0.4, -0.2, 0.8).finished();

/// A gradient whose strain is E = (F^T F - 1)/2 for a change (E_11, E_22, 2 E_12) of it: F's own with the right
/// Cauchy-Green tensor C changed.
Eigen::Matrix2d with_strain(const Eigen::Matrix2d& gradient, const Eigen::Vector3d& change) {
  Eigen::Matrix2d c = gradient.transpose() * gradient;
  c += (Eigen::Matrix2d() << 2 * change(0), change(2), change(2), 2 * change(1)).finished();
  // Cholesky's factor stretches as F does.
  const double a = std::sqrt(c(0, 0)), b = c(0, 1) / a, d = std::sqrt(c(1, 1) - b * b);
  return (Eigen::Matrix2d() << a, b, 0, d).finished();
}

double energy(const Eigen::Matrix2d& gradient) {
  const double trace = (gradient.transpose() * gradient).trace() + 1;
  return 0.5 * (trace / std::cbrt(std::pow(gradient.determinant(), 2)) - 3);
}

}  // namespace

TEST_CASE("neo-Hookean stress is the derivative of its energy, and the tangent that of the stress", "[core][finite]") {
  const NeoHookean at = neo_hookean(some_gradient);
  constexpr double step = 1e-6;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d change = step * Eigen::Vector3d::Unit(k);
    const Eigen::Matrix2d up = with_strain(some_gradient, change), down = with_strain(some_gradient, -change);
    const NeoHookean above = neo_hookean(up), below = neo_hookean(down);
    // Central differences: step squared, and rounding over the step.
    CHECK(std::abs((energy(up) - energy(down)) / (2 * step) - at.stress(k)) < 1e-8);
    CHECK(((above.stress - below.stress) / (2 * step) - at.tangent.col(k)).norm() < 1e-7);
    CHECK(std::abs((above.volume - below.volume) / (2 * step) - at.dilatation(k)) < 1e-8);
    CHECK(((above.dilatation - below.dilatation) / (2 * step) - at.of_pressure.col(k)).norm() < 1e-7);
  }
}

TEST_CASE("a neo-Hookean solid has unit shear modulus at small strains", "[core][finite]") {
  constexpr double small = 1e-7;
  const NeoHookean sheared = neo_hookean((Eigen::Matrix2d() << 1, small, 0, 1).finished());
  CHECK(std::abs(sheared.stress(2) / small - 1) < 1e-6);
  const NeoHookean stretched = neo_hookean((Eigen::Matrix2d() << 1 + small, 0, 0, 1 - small).finished());
  CHECK(std::abs(stretched.stress(0) / (2 * small) - 1) < 1e-6);
  CHECK(std::abs(stretched.stress(1) / (2 * small) + 1) < 1e-6);
}
