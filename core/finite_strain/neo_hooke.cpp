#include "core/finite_strain/neo_hooke.hpp"

#include <Eigen/LU>
#include <cmath>

namespace rollres {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// -dC^-1/dE: dC^-1 = -2 C^-1 dE C^-1, for components (11, 22, 12) and strains (E_11, E_22, 2 E_12).
Matrix3d inverse_change(const Vector3d& c) {
  const double a = c(0), b = c(1), m = c(2);
  Matrix3d change;
  change << 2 * a * a, 2 * m * m, 2 * a * m,  //
      2 * m * m, 2 * b * b, 2 * b * m,        //
      2 * a * m, 2 * b * m, a * b + m * m;
  return change;
}

}  // namespace

NeoHookean neo_hookean(const Eigen::Matrix2d& gradient) {
  NeoHookean at;
  const double j = at.volume = gradient.determinant();
  const Eigen::Matrix2d c = gradient.transpose() * gradient;
  const Vector3d inverse = Vector3d(c(1, 1), c(0, 0), -c(0, 1)) / (j * j), one(1, 1, 0);
  const double trace = c(0, 0) + c(1, 1) + 1, scale = j > 0 ? 1 / std::cbrt(j * j) : NAN;
  const Matrix3d change = inverse_change(inverse);
  const Vector3d deviator = one - trace / 3 * inverse;
  at.stress = scale * deviator;
  // dJ^(-2/3) = -2/3 J^(-2/3) C^-1 . dE, dt = 2 (1 . dE).
  at.tangent =
      scale * (-2.0 / 3 * deviator * inverse.transpose() - 2.0 / 3 * inverse * one.transpose() + trace / 3 * change);
  at.dilatation = j * inverse;
  at.of_pressure = j * (inverse * inverse.transpose() - change);
  return at;
}

}  // namespace rollres
