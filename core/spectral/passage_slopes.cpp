#include "core/spectral/passage_slopes.hpp"

#include <cmath>
#include <utility>

namespace rollres {

using complex = std::complex<double>;

PassageSlopes::PassageSlopes(SteadySurface surface, const CreepSpectrum& deep, double depth, bool rigid_base,
                             bool sheared)
    : surface_(std::move(surface)),
      deep_(deep),
      depth_(depth),
      rigid_base_(rigid_base),
      pressed_(surface_.curvature(RingCurvature::Of::pressure).over(deep_)),
      sheared_(sheared ? surface_.curvature(RingCurvature::Of::shear).over(deep_) : RingCurvature()),
      table_(first_memory_ + deep.terms.size(), sheared_.none() ? 3 : 4, 0.1 * depth_ / surface_.longest_wave(),
             [this](double wavenumber, std::span<complex> values) { transform(wavenumber, values); }) {
  const SurfaceCompliance at_rest = surface_.half_spaces(surface_.moduli(0));
  at_rest_ = 2 / deep_.at_rest() * Eigen::Array2d(at_rest.normal.real(), at_rest.longitudinal.real());
  std::vector<double> lengths;
  for (const CreepSpectrum::Term& term : deep.terms) {
    lengths.push_back(surface_.speed() * term.time);
    memory_lengths_.push_back(lengths.back() / depth_);
  }
  pressed_memory_ = pressed_.remembered(lengths);
  if (sheared) sheared_memory_ = sheared_.remembered(lengths);
}

void PassageSlopes::transform(double k, std::span<complex> values) const {
  constexpr complex i(0, 1);
  const double along = k / depth_;
  const SteadySurface::Moduli moduli = surface_.moduli(along);
  const SurfaceCompliance c = surface_(moduli, along, 0), c_deep = surface_.half_spaces(moduli);
  const complex per_deep = 1 / M_PI / deep_(-along * surface_.speed());
  const complex normal = (along * c.normal - c_deep.normal) * per_deep - pressed_(along) / M_PI;
  const complex tangential = (along * c.longitudinal - c_deep.longitudinal) * per_deep;
  const complex cross = (along * c.cross - c_deep.cross) * per_deep;
  const complex hoop = sheared_.none() ? 0 : along * c.hoop * per_deep - sheared_(along) / M_PI;
  const std::size_t components = sheared_.none() ? 3 : 4;
  const auto put = [&](std::size_t function, const complex& n, const complex& t, const complex& x, const complex& h) {
    const std::size_t first = components * function;
    values[first] = n;
    values[first + 1] = t;
    values[first + 2] = x;
    if (components > 3) values[first + 3] = h;
  };
  put(slopes_, i * normal, i * tangential, -cross, -hoop);
  // With the half-space's -ln|x|/(2 pi) but for its long waves, which ln(x^2 + 4 depth^2)/(4 pi) takes.
  const double half_space = 0.5 / M_PI * std::exp(-2 * k);
  put(displacements_, (normal + at_rest_(0) * half_space + pressed_.at_rest() / M_PI * std::exp(-2 * k)) / k,
      (tangential + at_rest_(1) * half_space) / k, i * cross / k, i * hoop / k);
  for (std::size_t m = 0; m < memory_lengths_.size(); ++m) {
    const complex mean = 1.0 / (1.0 - i * k * memory_lengths_[m]);
    put(first_memory_ + m, i * mean * normal, i * mean * tangential, -mean * cross, -mean * hoop);
  }
}

LayerSlopes PassageSlopes::slope(double x) const {
  LayerSlopes sum = table_(slopes_, x / depth_) / depth_;
  if (pressed_.none()) return sum;
  sum(layer_slope::normal) += pressed_.slope(x);
  if (!sheared_.none()) sum(layer_slope::hoop) += sheared_.slope(x);
  return sum;
}

LayerSlopes PassageSlopes::memory(std::size_t term, double x) const {
  LayerSlopes sum = table_(first_memory_ + term, x / depth_) / depth_;
  if (pressed_.none()) return sum;
  sum(layer_slope::normal) += pressed_memory_[term].slope(x);
  if (!sheared_.none()) sum(layer_slope::hoop) += sheared_memory_[term].slope(x);
  return sum;
}

RingLogarithms PassageSlopes::logarithms(double finest) const {
  return {pressed_.logarithmic_slope(finest), sheared_.logarithmic_slope(finest)};
}

RingLogarithms PassageSlopes::memory_logarithms(std::size_t term, double finest) const {
  if (pressed_.none()) return {};
  return {pressed_memory_[term].logarithmic_slope(finest),
          sheared_.none() ? LogarithmicSlope() : sheared_memory_[term].logarithmic_slope(finest)};
}

LayerSlopes PassageSlopes::displacement(double x) const {
  if (!rigid_base_) return LayerSlopes::Constant(NAN);
  LayerSlopes sum = table_(displacements_, x / depth_);
  const double logarithm = std::log(x * x + 4 * depth_ * depth_) / (4 * M_PI);
  sum.head<2>() += at_rest_ * logarithm;
  if (pressed_.none()) return sum;
  sum(layer_slope::normal) += 2 * pressed_.at_rest() * logarithm + pressed_.displacement(x);
  if (!sheared_.none()) sum(layer_slope::hoop) += sheared_.displacement(x);
  return sum;
}

}  // namespace rollres
