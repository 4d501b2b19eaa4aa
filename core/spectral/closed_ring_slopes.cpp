#include "core/spectral/closed_ring_slopes.hpp"

#include <array>
#include <cmath>
#include <utility>

namespace rollres {

namespace {

using complex = std::complex<double>;

/// The ring's compliance over the spectrum, as slopes, displacements, and slopes seen through each memory.
EarlierTurns turns_of(const SteadySurface& ring, double radius, const CreepSpectrum& deep, double speed,
                      bool foundation, bool sheared) {
  const std::size_t components = sheared ? 4 : 3, functions = 2 + deep.terms.size();
  const auto transform = [&](double along, std::span<complex> values) {
    constexpr complex i(0, 1);
    const SurfaceCompliance c = ring(ring.moduli(along), along, 0);
    const complex per_deep = 1 / M_PI / deep(-along * speed), across = (foundation ? i : -i) * per_deep;
    const std::array<complex, 4> displacements{c.normal * per_deep, c.longitudinal * per_deep, c.cross * across,
                                               c.hoop * across};
    for (std::size_t component = 0; component < components; ++component) {
      const complex slope = i * along * displacements[component];
      values[component] = slope;
      values[components + component] = displacements[component];
      for (std::size_t m = 0; m < deep.terms.size(); ++m)
        values[(2 + m) * components + component] = slope / (1.0 - i * along * speed * deep.terms[m].time);
    }
  };
  return {radius, ring.longest_wave(), functions, static_cast<Eigen::Index>(components), transform};
}

}  // namespace

ClosedRingSlopes::ClosedRingSlopes(std::shared_ptr<const SlopeCorrection> passage, const SteadySurface& ring,
                                   double radius, const CreepSpectrum& deep, double speed, bool foundation,
                                   bool sheared)
    : passage_(std::move(passage)), turns_(turns_of(ring, radius, deep, speed, foundation, sheared)) {}

}  // namespace rollres
