#include "core/interior/ring_depth_response.hpp"

#include <algorithm>
#include <cmath>

namespace rollres {

using complex = std::complex<double>;
using Matrix2 = Eigen::Matrix2cd;
using Vector2 = Eigen::Vector2cd;

RingDepthResponse::RingDepthResponse(const LayeredMedium& rings, std::span<const complex> moduli, double wavenumber,
                                     const SurfaceTractions::Transforms& tractions)
    : harmonic_(wavenumber * rings.front().radius) {
  const double reach = DepthResponse::vanished / harmonic_;  // in ln r
  double above = 0;
  for (std::size_t i = 0; i < rings.size() && above < reach; ++i) {
    const double through = -std::log1p(-rings[i].thickness / rings[i].radius), felt = std::min(through, reach - above);
    const RingWaves waves(harmonic_, rings[i].poisson_ratio);
    const int steps = waves.steps(felt);
    rings_.push_back({waves, moduli[i], rings[i].radius, rings[i].poisson_ratio, felt / steps,
                      std::vector<Eigen::Vector4cd>(static_cast<std::size_t>(steps))});
    above += through;
  }
  // From the core up, of each step: what its inner face yields, and the stress there per that outside.
  struct Carried {
    Matrix2 give, inwards;
  };
  std::vector<std::vector<Carried>> all(rings_.size());
  Matrix2 give = Matrix2::Zero();
  for (std::size_t i = rings_.size(); i-- > 0;) {
    const Ring& ring = rings_[i];
    const Eigen::Matrix4d step = ring.waves.outwards(ring.step);
    give *= ring.modulus;
    for (std::size_t j = 0; j < ring.states.size(); ++j) {
      const RingStep carried(step, give);
      all[i].push_back({give, carried.inwards});
      give = carried.give;
    }
    give /= ring.modulus;
  }
  // sigma_rphi is the factor of sin(n phi), -i times that of e^{i n phi}.
  Vector2 stress = rings.front().radius * Vector2(-tractions.pressure, complex(0, 1) * tractions.shear);
  for (std::size_t i = 0; i < rings_.size(); ++i) {
    Ring& ring = rings_[i];
    stress /= ring.modulus;
    for (std::size_t j = ring.states.size(); j-- > 0;) {
      stress = (all[i][j].inwards * stress).eval();
      ring.states[j] << all[i][j].give * stress, stress;
    }
    stress *= ring.modulus;
  }
}

DepthState RingDepthResponse::at(std::size_t index, double depth) const {
  if (index >= rings_.size()) return {};
  const Ring& ring = rings_[index];
  const auto last = static_cast<int>(ring.states.size()) - 1;
  const double from_core = (last + 1) * ring.step + std::log1p(-depth / ring.outer);
  if (from_core < -0.5 * ring.step) return {};  // less is rounding
  const int step = std::clamp(static_cast<int>(from_core / ring.step), 0, last);
  const Eigen::Vector4cd y =
      ring.waves.outwards(from_core - step * ring.step) * ring.states[static_cast<std::size_t>(step)];
  constexpr complex i{0, 1};
  const double radius = ring.outer - depth, nu = ring.poisson_ratio;
  const complex outwards = y(0) / ring.waves.scale(), around = y(1) / ring.waves.scale();
  const complex normal = ring.modulus * y(2) / radius;
  // sigma_phiphi from the strain around the ring.
  return {
      .u = -i * around,
      .w = outwards,
      .stress = {.x = nu / (1 - nu) * normal + 2.0 / (1 - nu) * ring.modulus * (harmonic_ * around + outwards) / radius,
                 .z = normal,
                 .xz = -i * ring.modulus * y(3) / radius}};
}

}  // namespace rollres
