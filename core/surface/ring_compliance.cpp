#include "core/surface/ring_compliance.hpp"

#include <cmath>

#include "core/surface/ring_waves.hpp"

namespace rollres {

namespace {

using complex = std::complex<double>;
using Eigen::Matrix2cd;

/// Of the disc, times k and of unit modulus.
SurfaceCompliance disc(double n, double nu) {
  const double normal = ((1 - nu) * n * n - 0.5 * (1 - 2 * nu) * n) / (n * n - 1);
  return {.normal = normal, .longitudinal = 1 - nu, .cross = -0.5 * (1 - 2 * nu), .transverse = 1, .hoop = normal / n};
}

/// Displacements, times the scale of waves, per r times the stress on the outer face [1/Pa].
Matrix2cd through(const MediumLayer& ring, complex modulus, double n, const Matrix2cd& inner) {
  const double h = -std::log1p(-ring.thickness / ring.radius);
  const RingWaves waves(n, ring.poisson_ratio);
  const int steps = waves.steps(h);
  const Eigen::Matrix4d step = waves.outwards(h / steps);
  Matrix2cd give = inner * modulus;
  for (int i = 0; i < steps; ++i) give = RingStep(step, give).give;
  return give / modulus;
}

}  // namespace

bool is_ring(const LayeredMedium& medium) { return !medium.empty() && std::isfinite(medium.front().radius); }

SurfaceCompliance ring_compliance(const LayeredMedium& rings, std::span<const complex> moduli, double wavenumber) {
  const double n = wavenumber * rings.front().radius;
  const auto scaled = [&](SurfaceCompliance c, complex by) {
    return SurfaceCompliance{c.normal * by, c.longitudinal * by, c.cross * by, c.transverse * by, c.hoop * by};
  };
  constexpr double faded = 19;  // e^-38: the core is not felt
  if (-n * std::log1p(-rings.front().thickness / rings.front().radius) > faded)
    return scaled(disc(n, rings.front().poisson_ratio), 1.0 / (moduli.front() * wavenumber));
  const double scale = RingWaves::scale_of(n);
  Matrix2cd give = Matrix2cd::Zero();
  complex sheared = 0;  // n v per r times the stress across the wave: antiplane shear is that of flat layers in ln r
  for (std::size_t i = rings.size(); i-- > 0;) {
    give = through(rings[i], moduli[i], n, give);
    const double depth = -std::log1p(-rings[i].thickness / rings[i].radius), fixed = std::tanh(n * depth);
    sheared = (sheared * moduli[i] + fixed) / (1.0 + sheared * moduli[i] * fixed) / moduli[i];
  }
  // k u = n u/R per stress, r sigma = R sigma; the strain of u_phi sin(n phi) is (n u_phi + u_r)/R.
  const double per = 1 / (scale * wavenumber);
  return {.normal = n * give(0, 0) * per,
          .longitudinal = (n * give(1, 1) + give(0, 1)) * per,
          .cross = -(n * give(1, 0) + give(0, 0)) * per,
          .transverse = sheared / wavenumber,
          .hoop = give(0, 0) * per};
}

}  // namespace rollres
