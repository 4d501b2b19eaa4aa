#include "core/surface/layered_medium.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/solution_limits.hpp"
#include "core/surface/layer_waves.hpp"
#include "core/surface/ring_compliance.hpp"

namespace rollres {

namespace {

using complex = std::complex<double>;
using Matrix2 = Eigen::Matrix2cd;

/// What lies below a depth: displacements (along, down) per stress (shear, normal), and the same across the wave.
struct Below {
  Matrix2 compliance = Matrix2::Zero();
  complex transverse = 0;
};

}  // namespace

SurfaceCompliance surface_compliance(const LayeredMedium& medium, std::span<const complex> moduli, double wavenumber,
                                     double wave_speed) {
  require_time();
  if (is_ring(medium)) return ring_compliance(medium, moduli, wavenumber);
  Below below;
  for (std::size_t i = medium.size(); i-- > 0;) {
    const MediumLayer& layer = medium[i];
    const complex stiffness = moduli[i] * wavenumber;  // G k
    const LayerWaves waves(wavenumber, moduli[i], layer, wave_speed);
    const Waves near = waves.at(0);
    const complex beta = waves.beta();
    if (std::isinf(layer.thickness)) {
      below.compliance = near.displacements * inverse(Matrix2(near.stresses * stiffness));
      below.transverse = -1.0 / (stiffness * beta);
      continue;
    }
    // At the lower face: what comes down, and what goes up from there so that both fit what lies below.
    const Waves far = waves.at(layer.thickness), up_far = far.mirrored();
    const Matrix2 reflected = reflection(near, far, below.compliance * stiffness);
    below.compliance = (near.displacements + up_far.displacements * reflected) *
                       inverse(Matrix2((near.stresses + up_far.stresses * reflected) * stiffness));
    const complex decay = waves.transverse_decay(layer.thickness), give = below.transverse * stiffness * beta;
    const complex back = -(1.0 + give) / (1.0 - give) * decay * decay;
    below.transverse = (1.0 + back) / ((back - 1.0) * stiffness * beta);
  }
  // Tractions on the surface are opposite to the stresses at a face with its normal downwards.
  const Matrix2& c = below.compliance;
  return {.normal = -c(1, 1), .longitudinal = -c(0, 0), .cross = -c(0, 1), .transverse = -below.transverse};
}

SurfaceCompliance half_space_compliance(const MediumLayer& layer, complex modulus, double wave_speed) {
  const LayeredMedium half_space{{INFINITY, layer.poisson_ratio, layer.density, {}}};
  return surface_compliance(half_space, {&modulus, 1}, 1, wave_speed);
}

double finite_thickness(const LayeredMedium& medium) {
  double sum = 0;
  for (const MediumLayer& layer : medium)
    if (std::isfinite(layer.thickness)) sum += layer.thickness;
  return sum;
}

std::vector<complex> moduli_at(const LayeredMedium& medium, double omega) {
  std::vector<complex> moduli;
  require_time();
  for (const MediumLayer& layer : medium) moduli.push_back(1.0 / layer.material(omega));
  return moduli;
}

bool carries_slower_waves(const LayeredMedium& medium, double speed) {
  if (medium.size() < 2) return false;
  double thinnest = INFINITY;
  for (const MediumLayer& layer : medium) thinnest = std::min(thinnest, layer.thickness);
  const std::vector<complex> at_rest = moduli_at(medium, 0);
  const double highest = 20 / thinnest;
  for (double k = 1e-2 / finite_thickness(medium); k < highest; k *= 1.1) {
    const SurfaceCompliance c = surface_compliance(medium, at_rest, k, speed);
    const double normal = c.normal.real(), cross = c.cross.real();
    if (!(normal > 0 && normal * c.longitudinal.real() > cross * cross && c.transverse.real() > 0)) return true;
  }
  return false;
}

SurfaceCompliance surface_compliance(const LayeredMedium& medium, double wavenumber, double cosine, double speed) {
  return surface_compliance(medium, moduli_at(medium, -wavenumber * cosine * speed), wavenumber, speed * cosine);
}

}  // namespace rollres
