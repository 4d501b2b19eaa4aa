#include "core/surface/ring_compliance.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace rollres {

namespace {

using complex = std::complex<double>;
using Eigen::Matrix2cd;
using Eigen::Matrix4d;

/// A n times the displacements, which keeps its entries of the size of n.
Matrix4d state_matrix(double n, double scale, double nu) {
  const double f = 1 / (1 - nu);
  Matrix4d a;
  a << -nu * f, -n * nu * f, scale * 0.5 * (1 - 2 * nu) * f, 0,  //
      n, 1, 0, scale,                                            //
      2 * f / scale, 2 * n * f / scale, nu * f, -n,              //
      2 * n * f / scale, 2 * n * n * f / scale, n * nu * f, -1;
  return a;
}

/// sinh(x h)/x
double sinh_over(double x, double h) { return x == 0 ? h : std::sinh(x * h) / x; }

/// [sinh((n+1)h)/(n+1) - sinh((n-1)h)/(n-1)]/(4n), by its series in h where the difference would cancel.
double sinh_difference(double n, double h) {
  if ((n + 1) * h > 1) return (sinh_over(n + 1, h) - sinh_over(n - 1, h)) / (4 * n);
  const double s = n * n + 1;  // half the sum of (n+1)^2 and (n-1)^2, whose difference is 4n
  double difference = 1, sum = s, factor = h * h * h / 6, all = factor;  // ((n+1)^2j -+ (n-1)^2j)/(4n), /2
  for (int j = 2; j < 12; ++j) {
    const double next = s * difference + sum;
    sum = s * sum + 4 * n * n * difference;
    difference = next;
    factor *= h * h / ((2 * j) * (2 * j + 1));
    all += factor * difference;
  }
  return all;
}

/// exp(A h): cosh and sinh of A, whose square has the twofold eigenvalues (n - 1)^2 and (n + 1)^2.
Matrix4d propagator(const Matrix4d& a, double n, double h) {
  const Matrix4d excess = a * a - (n - 1) * (n - 1) * Matrix4d::Identity();
  const Matrix4d even = std::cosh((n - 1) * h) * Matrix4d::Identity() + 0.5 * sinh_over(n, h) * std::sinh(h) * excess;
  const Matrix4d odd = sinh_over(n - 1, h) * Matrix4d::Identity() + sinh_difference(n, h) * excess;
  return even + a * odd;
}

/// Normal, along and cross of the disc, times k and of unit modulus.
SurfaceCompliance disc(double n, double nu) {
  return {.normal = ((1 - nu) * n * n - 0.5 * (1 - 2 * nu) * n) / (n * n - 1),
          .longitudinal = 1 - nu,
          .cross = -0.5 * (1 - 2 * nu),
          .transverse = 0};
}

/// Displacements, times `scale`, per r times the stress on the outer face [1/Pa].
Matrix2cd through(const MediumLayer& ring, complex modulus, double n, double scale, const Matrix2cd& inner) {
  const double h = -std::log1p(-ring.thickness / ring.radius);
  constexpr double most = 1.5;  // that growing waves grow by at a time, as a power of e
  const int steps = std::max(1, static_cast<int>(std::ceil((n + 1) * h / most)));
  const Matrix4d step = propagator(state_matrix(n, scale, ring.poisson_ratio), n, h / steps);
  const auto uu = step.topLeftCorner<2, 2>(), us = step.topRightCorner<2, 2>(), su = step.bottomLeftCorner<2, 2>(),
             ss = step.bottomRightCorner<2, 2>();
  Matrix2cd give = inner * modulus;
  for (int i = 0; i < steps; ++i) {
    const Matrix2cd stress = su * give + ss;
    give = ((uu * give + us) * stress.inverse()).eval();
  }
  return give / modulus;
}

}  // namespace

bool is_ring(const LayeredMedium& medium) { return !medium.empty() && std::isfinite(medium.front().radius); }

SurfaceCompliance ring_compliance(const LayeredMedium& rings, std::span<const complex> moduli, double wavenumber) {
  const double n = wavenumber * rings.front().radius;
  const auto scaled = [&](SurfaceCompliance c, complex by) {
    return SurfaceCompliance{c.normal * by, c.longitudinal * by, c.cross * by, c.transverse * by};
  };
  constexpr double faded = 19;  // e^-38: the core is not felt
  if (-n * std::log1p(-rings.front().thickness / rings.front().radius) > faded)
    return scaled(disc(n, rings.front().poisson_ratio), 1.0 / (moduli.front() * wavenumber));
  const double scale = std::max(n, 1.0);
  Matrix2cd give = Matrix2cd::Zero();
  for (std::size_t i = rings.size(); i-- > 0;) give = through(rings[i], moduli[i], n, scale, give);
  // k u = n u/R per stress, r sigma = R sigma; the strain of u_phi sin(n phi) is (n u_phi + u_r)/R.
  const double per = 1 / (scale * wavenumber);
  return {.normal = n * give(0, 0) * per,
          .longitudinal = (n * give(1, 1) + give(0, 1)) * per,
          .cross = -(n * give(1, 0) + give(0, 0)) * per,
          .transverse = 0};
}

}  // namespace rollres
