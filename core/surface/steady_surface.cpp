#include "core/surface/steady_surface.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/numerics/solution_limits.hpp"
#include "core/surface/ring_compliance.hpp"
#include "core/surface/ring_curvature.hpp"

namespace rollres {

namespace {

/// Wavenumber times thickness that stands for 0.
constexpr double long_wave = 1e-4;

/// Of the surface and that of the body: the cross terms are opposite.
SurfaceCompliance together(const SurfaceCompliance& below, const SurfaceCompliance& body) {
  return {below.normal + body.normal, below.longitudinal + body.longitudinal, below.cross - body.cross,
          below.transverse + body.transverse, below.hoop - body.hoop};
}

}  // namespace

SteadySurface::SteadySurface(const Layer& layer, CreepSpectrum material, double speed)
    : composite_(false), layer_(layer), material_(std::move(material)), speed_(speed), thickness_(layer.thickness) {}

SteadySurface::SteadySurface(SurfaceMedia media, double speed)
    : composite_(true),
      layer_(media.foundation.front().thickness, media.foundation.front().poisson_ratio),
      media_(std::move(media)),
      speed_(speed),
      thickness_(0) {
  for (const LayeredMedium* const medium : {&media_.foundation, &media_.coating})
    for (const MediumLayer& each : *medium) thickness_ += each.thickness;
}

SteadySurface::Moduli SteadySurface::moduli(double along) const {
  const double omega = -along * speed_;
  if (!composite_) return {material_(omega), {}, {}};
  return {1, moduli_at(media_.foundation, omega), moduli_at(media_.coating, media_.backwards ? -omega : omega)};
}

SurfaceCompliance SteadySurface::operator()(const Moduli& moduli, double along, double across) const {
  require_time();
  double k = std::hypot(along, across);
  if (!composite_) {
    const LayerSymbols c = layer_symbols(k, layer_);
    const std::complex<double>& j = moduli.compliance;
    return {j * c.normal, j * c.longitudinal, j * c.cross, j * c.transverse};
  }
  const double wave_speed = k > 0 ? speed_ * along / k : 0;
  if (k == 0) k = long_wave / thickness_;  // the limit, to all digits that matter
  const SurfaceCompliance below = surface_compliance(media_.foundation, moduli.foundation, k, wave_speed);
  if (media_.coating.empty()) return below;
  return together(below, surface_compliance(media_.coating, moduli.coating, k, wave_speed));
}

SurfaceCompliance SteadySurface::half_spaces(const Moduli& moduli) const {
  if (!composite_) {
    const LayerSymbols c = half_space_symbols(layer_.poisson_ratio);
    const std::complex<double>& j = moduli.compliance;
    return {j * c.normal, j * c.longitudinal, j * c.cross, j * c.transverse};
  }
  const SurfaceCompliance below = half_space_compliance(media_.foundation.front(), moduli.foundation.front(), speed_);
  if (media_.coating.empty()) return below;
  return together(below, half_space_compliance(media_.coating.front(), moduli.coating.front(), speed_));
}

SurfaceCompliance SteadySurface::long_waves() const {
  if (!composite_) return std::isinf(layer_.thickness) ? half_spaces(moduli(0)) : SurfaceCompliance{};
  if (std::isfinite(media_.foundation.back().thickness)) return {};
  return half_space_compliance(media_.foundation.back(), 1.0 / media_.foundation.back().material(0), speed_);
}

RingCurvature SteadySurface::curvature(RingCurvature::Of of) const {
  if (is_ring(media_.coating)) return {media_.coating.front(), media_.backwards ? -speed_ : speed_, of, true};
  if (is_ring(media_.foundation)) return {media_.foundation.front(), speed_, of, false};
  return {};
}

double SteadySurface::longest_wave() const {
  double softest = INFINITY, hardest = 0, time = 0;
  const auto take = [&](const CreepSpectrum& material) {
    softest = std::min(softest, 1 / material.at_rest());
    hardest = std::max(hardest, 1 / material.at_rest());
    for (const CreepSpectrum::Term& term : material.terms) time = std::max(time, term.time);
  };
  if (!composite_) take(material_);
  for (const LayeredMedium* const medium : {&media_.foundation, &media_.coating})
    for (const MediumLayer& layer : *medium) take(layer.material);
  const double thickness =
      composite_ ? finite_thickness(media_.foundation) + finite_thickness(media_.coating) : layer_.thickness;
  double round = 0;  // radius of rings
  for (const LayeredMedium* const medium : {&media_.foundation, &media_.coating})
    if (is_ring(*medium)) round = medium->front().radius;
  return std::max({(std::isinf(thickness) ? 0 : thickness) * std::cbrt(hardest / softest), speed_ * time, round});
}

}  // namespace rollres
