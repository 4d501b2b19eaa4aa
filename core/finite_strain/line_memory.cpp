#include "core/finite_strain/line_memory.hpp"

#include <Eigen/LU>
#include <cmath>

#include "core/numerics/quadrature.hpp"

namespace rollres {

namespace {

/// Coefficients a_0, a_1, a_2 of the quadratics that are 1 at one Gauss point and 0 at the others, as columns.
Eigen::Matrix3d point_quadratics() {
  Eigen::Matrix3d powers;
  for (int i = 0; i < 3; ++i) powers.row(i) << 1, gauss_places[i], gauss_places[i] * gauss_places[i];
  return powers.inverse();
}

/// int_0^z e^(-length (z - y)) length y^n dy for n = 0, 1, 2: weights of the powers in r(z).
Eigen::RowVector3d power_means(double length, double z) {
  Eigen::RowVector3d means;
  if (length < 2) {
    const QuadratureRule& rule = gauss_rule(10);
    means.setZero();
    for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
      const double y = z * rule.nodes[k];
      const double weight = z * rule.weights[k] * length * std::exp(-length * (z - y));
      means += weight * Eigen::RowVector3d(1, y, y * y);
    }
    return means;
  }
  const double t = 1 / length, left = std::exp(-length * z);
  means << 1 - left, z - t + t * left, z * z - 2 * t * z + 2 * t * t - 2 * t * t * left;
  return means;
}

}  // namespace

CellMemory cell_memory(double length) {
  static const Eigen::Matrix3d quadratics = point_quadratics();
  CellMemory memory;
  for (int i = 0; i < 3; ++i) {
    memory.decay(i) = std::exp(-length * gauss_places[i]);
    memory.weight.row(i) = power_means(length, gauss_places[i]) * quadratics;
  }
  memory.through = std::exp(-length);
  memory.out = (power_means(length, 1) * quadratics).transpose();
  return memory;
}

}  // namespace rollres
