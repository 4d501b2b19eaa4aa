#include "core/surface/ring_waves.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace rollres {

using Eigen::Matrix4d;

namespace {

/// sinh(x h)/x
double sinh_over(double x, double h) { return x == 0 ? h : std::sinh(x * h) / x; }

/// [sinh((n+1)h)/(n+1) - sinh((n-1)h)/(n-1)]/(4n), by its series in h where the difference would cancel; h up to 1.5.
double sinh_difference(double n, double h) {
  if (n > 0.5 && (n + 1) * h > 1) return (sinh_over(n + 1, h) - sinh_over(n - 1, h)) / (4 * n);
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

}  // namespace

RingWaves::RingWaves(double harmonic, double poisson_ratio) : n_(harmonic), scale_(scale_of(harmonic)) {
  const double n = n_, nu = poisson_ratio, f = 1 / (1 - nu);
  a_ << -nu * f, -n * nu * f, scale_ * 0.5 * (1 - 2 * nu) * f, 0,  //
      n, 1, 0, scale_,                                             //
      2 * f / scale_, 2 * n * f / scale_, nu * f, -n,              //
      2 * n * f / scale_, 2 * n * n * f / scale_, n * nu * f, -1;
  excess_ = a_ * a_ - (n - 1) * (n - 1) * Matrix4d::Identity();
}

double RingWaves::scale_of(double harmonic) { return std::max(harmonic, 1.0); }

/// cosh and sinh of A, whose square has the twofold eigenvalues (n - 1)^2 and (n + 1)^2.
Matrix4d RingWaves::outwards(double h) const {
  const double n = n_;
  const Matrix4d even = std::cosh((n - 1) * h) * Matrix4d::Identity() + 0.5 * sinh_over(n, h) * std::sinh(h) * excess_;
  const Matrix4d odd = sinh_over(n - 1, h) * Matrix4d::Identity() + sinh_difference(n, h) * excess_;
  return even + a_ * odd;
}

int RingWaves::steps(double h) const {
  constexpr double most = 1.5;
  return std::max(1, static_cast<int>(std::ceil((n_ + 1) * h / most)));
}

RingStep::RingStep(const Matrix4d& outwards, const Eigen::Matrix2cd& inner)
    : inwards((outwards.bottomLeftCorner<2, 2>() * inner + outwards.bottomRightCorner<2, 2>()).inverse()) {
  give = (outwards.topLeftCorner<2, 2>() * inner + outwards.topRightCorner<2, 2>()) * inwards;
}

}  // namespace rollres
