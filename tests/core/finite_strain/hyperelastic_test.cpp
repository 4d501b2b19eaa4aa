#include "core/finite_strain/hyperelastic.hpp"

#include <Eigen/LU>
#include <cmath>

#include "tests/catch.hpp"

using namespace rollres;

namespace {

const Eigen::Matrix2d some_gradient = (Eigen::Matrix2d() << 1.3, 0.4, -0.2, 0.8).finished();
const YeohRatios softer_then_stiffer{-0.3, 0.2};

/// A gradient whose strain is E = (F^T F - 1)/2 for a change (E_11, E_22, 2 E_12) of it: F's own with the right
/// Cauchy-Green tensor C changed.
Eigen::Matrix2d with_strain(const Eigen::Matrix2d& gradient, const Eigen::Vector3d& change) {
  Eigen::Matrix2d c = gradient.transpose() * gradient;
  c += (Eigen::Matrix2d() << 2 * change(0), change(2), change(2), 2 * change(1)).finished();
  // Cholesky's factor stretches as F does.
  const double a = std::sqrt(c(0, 0)), b = c(0, 1) / a, d = std::sqrt(c(1, 1) - b * b);
  return (Eigen::Matrix2d() << a, b, 0, d).finished();
}

double energy(const Eigen::Matrix2d& gradient, const YeohRatios& yeoh) {
  const double trace = (gradient.transpose() * gradient).trace() + 1;
  const double beyond = trace / std::cbrt(std::pow(gradient.determinant(), 2)) - 3;
  return 0.5 * beyond * (1 + beyond * (yeoh.second + beyond * yeoh.third));
}

/// Cauchy's stress, of the part that keeps the volume.
Eigen::Matrix2d true_stress(const Eigen::Matrix2d& gradient, const YeohRatios& yeoh) {
  const Hyperelastic at = hyperelastic(gradient, yeoh);
  Eigen::Matrix2d stress;
  stress << at.stress(0), at.stress(2), at.stress(2), at.stress(1);
  return gradient * stress * gradient.transpose() / at.volume;
}

}  // namespace

TEST_CASE("hyperelastic stress is the derivative of its energy, and the tangent that of the stress", "[core][finite]") {
  for (const YeohRatios& yeoh : {YeohRatios{}, softer_then_stiffer}) {
    const Hyperelastic at = hyperelastic(some_gradient, yeoh);
    constexpr double step = 1e-6;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d change = step * Eigen::Vector3d::Unit(k);
      const Eigen::Matrix2d up = with_strain(some_gradient, change), down = with_strain(some_gradient, -change);
      const Hyperelastic above = hyperelastic(up, yeoh), below = hyperelastic(down, yeoh);
      // Central differences: step squared, and rounding over the step.
      CHECK(std::abs((energy(up, yeoh) - energy(down, yeoh)) / (2 * step) - at.stress(k)) < 1e-8);
      CHECK(((above.stress - below.stress) / (2 * step) - at.tangent.col(k)).norm() < 1e-7);
      CHECK(std::abs((above.volume - below.volume) / (2 * step) - at.dilatation(k)) < 1e-8);
      CHECK(((above.dilatation - below.dilatation) / (2 * step) - at.of_pressure.col(k)).norm() < 1e-7);
    }
    CHECK((at.tangent - at.tangent.transpose()).norm() < 1e-14);
  }
}

TEST_CASE("a hyperelastic solid has unit shear modulus at small strains", "[core][finite]") {
  constexpr double small = 1e-7;
  for (const YeohRatios& yeoh : {YeohRatios{}, softer_then_stiffer}) {
    const Hyperelastic sheared = hyperelastic((Eigen::Matrix2d() << 1, small, 0, 1).finished(), yeoh);
    CHECK(std::abs(sheared.stress(2) / small - 1) < 1e-6);
    const Hyperelastic stretched = hyperelastic((Eigen::Matrix2d() << 1 + small, 0, 0, 1 - small).finished(), yeoh);
    CHECK(std::abs(stretched.stress(0) / (2 * small) - 1) < 1e-6);
    CHECK(std::abs(stretched.stress(1) / (2 * small) + 1) < 1e-6);
  }
}

TEST_CASE("Yeoh's solid has its closed forms in simple shear and in plane-strain compression", "[core][finite]") {
  const double second = softer_then_stiffer.second, third = softer_then_stiffer.third;
  const auto slope = [&](double beyond) { return 1 + 2 * second * beyond + 3 * third * beyond * beyond; };
  for (const double shear : {0.1, 0.7, 1.5}) {
    // tau = g W'(3 + g^2), and the first normal stress difference is g tau.
    const Eigen::Matrix2d stress = true_stress((Eigen::Matrix2d() << 1, shear, 0, 1).finished(), softer_then_stiffer);
    const double tau = shear * slope(shear * shear);
    CHECK(std::abs(stress(0, 1) - tau) < 1e-14 * (1 + tau));
    CHECK(std::abs(stress(0, 0) - stress(1, 1) - shear * tau) < 1e-14 * (1 + shear * tau));
  }
  for (const double stretch : {1.2, 2.0}) {
    const double beyond = std::pow(stretch - 1 / stretch, 2);
    const Eigen::Matrix2d stress =
        true_stress((Eigen::Matrix2d() << stretch, 0, 0, 1 / stretch).finished(), softer_then_stiffer);
    const double difference = (stretch * stretch - 1 / (stretch * stretch)) * slope(beyond);
    CHECK(std::abs(stress(0, 0) - stress(1, 1) - difference) < 1e-13 * difference);
  }
}

TEST_CASE("Yeoh's solid without its two terms is the neo-Hookean one", "[core][finite]") {
  // S = J^(-2/3) (1 - t/3 C^-1), written out.
  const double j = some_gradient.determinant(), scale = 1 / std::cbrt(j * j);
  const Eigen::Matrix2d c = some_gradient.transpose() * some_gradient;
  const Eigen::Vector3d inverse = Eigen::Vector3d(c(1, 1), c(0, 0), -c(0, 1)) / (j * j);
  const double trace = c(0, 0) + c(1, 1) + 1;
  const Eigen::Vector3d expected = scale * (Eigen::Vector3d(1, 1, 0) - trace / 3 * inverse);
  CHECK((hyperelastic(some_gradient, {0, 0}).stress - expected).norm() < 1e-14 * expected.norm());
}
