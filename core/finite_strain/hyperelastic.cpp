#include "core/finite_strain/hyperelastic.hpp"

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

Hyperelastic hyperelastic(const Eigen::Matrix2d& gradient, const YeohRatios& yeoh) {
  Hyperelastic at;
  const double j = at.volume = gradient.determinant();
  const Eigen::Matrix2d c = gradient.transpose() * gradient;
  const Vector3d inverse = Vector3d(c(1, 1), c(0, 0), -c(0, 1)) / (j * j), one(1, 1, 0);
  const double trace = c(0, 0) + c(1, 1) + 1, scale = j > 0 ? 1 / std::cbrt(j * j) : NAN;
  const Matrix3d change = inverse_change(inverse);
  const Vector3d deviator = one - trace / 3 * inverse;
  // dJ^(-2/3) = -2/3 J^(-2/3) C^-1 . dE, dt = 2 (1 . dE).
  const Vector3d neo_hookean = scale * deviator;
  const Matrix3d its_tangent =
      scale * (-2.0 / 3 * deviator * inverse.transpose() - 2.0 / 3 * inverse * one.transpose() + trace / 3 * change);
  // dI = 2 neo_hookean . dE
  const double beyond = scale * trace - 3;
  const double slope = 1 + beyond * (2 * yeoh.second + 3 * yeoh.third * beyond);
  const double bend = 2 * yeoh.second + 6 * yeoh.third * beyond;
  at.stress = slope * neo_hookean;
  at.tangent = slope * its_tangent + 2 * bend * neo_hookean * neo_hookean.transpose();
  at.dilatation = j * inverse;
  at.of_pressure = j * (inverse * inverse.transpose() - change);
  return at;
}

}  // namespace rollres
