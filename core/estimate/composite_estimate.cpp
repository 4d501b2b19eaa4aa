#include "core/estimate/composite_estimate.hpp"

#include <array>
#include <cmath>

#include "core/numerics/bracketed_root.hpp"
#include "core/numerics/quadrature.hpp"
#include "core/surface/contact_surface.hpp"

namespace rollres {

namespace {

constexpr std::array<double, 13> borders{1e-4, 1e-3, 1e-2, 0.05, 0.2, 0.6, 1.5, 3, 5, 8, 12, 20, 40};

/// phi(z) and its derivative.
struct PressureTransform {
  double phi, change;

  PressureTransform(bool sphere, double z) {
    if (sphere) {
      const double sine = std::sin(z), cosine = std::cos(z);
      phi = z < 0.05 ? 1 - z * z / 10 : 3 * (sine - z * cosine) / (z * z * z);
      change = z < 0.05 ? -z / 5 : -3 * ((3 - z * z) * sine - 3 * z * cosine) / (z * z * z * z);
    } else {
      phi = 2 * ::j1(z) / z;
      change = -2 * ::jn(2, z) / z;
    }
  }
};

class HertzPressure {
 public:
  explicit HertzPressure(const RollingScene& scene)
      : sphere_(scene.indenter == Indenter::sphere), radius_(scene.radius), surface_(scene) {}

  ContactEstimate at(double half_width) const {
    const double a = half_width;
    const HertzResponse found = response(a, false);
    const double load = -(sphere_ ? 0.8 : 0.5) * a / (radius_ * found.slope);
    return {a, load * found.compliance + a * a / ((sphere_ ? 5 : 8) * radius_), load};
  }

  HertzResponse response(double half_width, bool with_loss) const {
    HertzResponse sum{0, 0, 0};
    for (std::size_t panel = 0; panel + 1 < borders.size(); ++panel) {
      const double from = borders[panel], to = borders[panel + 1];
      const QuadratureRule& rule = gauss_rule(to > 3 ? 10 : 6);
      for (std::size_t q = 0; q < rule.nodes.size(); ++q) {
        const double z = from + (to - from) * rule.nodes[q], k = z / half_width;
        const double weight = rule.weights[q] * (to - from) / half_width * (sphere_ ? k / (2 * M_PI) : 1 / M_PI);
        const PressureTransform transform(sphere_, z);
        const std::complex<double> c = surface_(surface_.moduli(k), k, 0).normal;
        sum.compliance += weight * std::abs(c) * transform.phi * transform.phi;
        sum.slope += weight * std::abs(c) * 2 * transform.phi * transform.change * k;
        if (with_loss) sum.loss += weight * lost(k, c) * transform.phi * transform.phi;
      }
    }
    return sum;
  }

 private:
  /// k Im c, in 3D the mean of k_x Im c over all directions of the wave.
  double lost(double k, const std::complex<double>& along_the_motion) const {
    if (!sphere_) return k * along_the_motion.imag();
    double mean = 0;
    const QuadratureRule& rule = gauss_rule(6);
    for (std::size_t q = 0; q < rule.nodes.size(); ++q) {
      const double angle = M_PI / 2 * rule.nodes[q], along = k * std::cos(angle), across = k * std::sin(angle);
      mean += rule.weights[q] * along * surface_(surface_.moduli(along), along, across).normal.imag();
    }
    return mean;
  }

  bool sphere_;
  double radius_;
  SteadySurface surface_;
};

}  // namespace

ContactEstimate composite_estimate(const RollingScene& scene) {
  const HertzPressure pressure(scene);
  const auto excess = [&](double log_half_width) {
    const ContactEstimate found = pressure.at(std::exp(log_half_width));
    return scene.load ? std::log(found.load / *scene.load) : std::log(found.approach / *scene.approach);
  };
  double low = std::log(0.1 * scene.radius), high = low;
  while (excess(low) > 0) low -= 1;
  while (excess(high) < 0) high += 1;
  ContactEstimate estimate = pressure.at(std::exp(bracketed_root(excess, low, high, 1e-3)));
  if (std::isinf(total_thickness(scene)) && scene.indenter == Indenter::cylinder) estimate.approach = NAN;
  return estimate;
}

HertzResponse hertz_response(const RollingScene& scene, double half_width) {
  return HertzPressure(scene).response(half_width, true);
}

}  // namespace rollres
