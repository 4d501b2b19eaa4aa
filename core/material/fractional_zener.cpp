#include "core/material/fractional_zener.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/numerics/solution_limits.hpp"

namespace rollres {

namespace {

/// Equal steps converge like e^{-2 pi d/step}, with d = pi/2 the distance of the closest pole, 1 + i omega tau e^s = 0.
constexpr double step = std::numbers::pi * std::numbers::pi / 17.5;

/// u with du/ds = 1 + 1/sqrt(s^2 + width^2), and its inverse.
struct Stretching {
  double width;
  double u(double s) const { return s + std::asinh(s / width); }
  double slope(double s) const { return 1 + 1 / std::hypot(s, width); }  // du/ds
  double s(double u) const {
    // Newton's method from outside, where the function is convex towards the root.
    double s = std::min(std::abs(u), width * std::sinh(std::min(std::abs(u), 700.0)));
    for (int pass = 0; pass < 100; ++pass) {
      const double change = (this->u(s) - std::abs(u)) / slope(s);
      s -= change;
      if (std::abs(change) <= 1e-15 * s) break;
    }
    return std::copysign(s, u);
  }
};

}  // namespace

std::complex<double> complex_modulus(const FractionalZener& solid, double omega) {
  const double angle = std::copysign(solid.order * std::numbers::pi / 2, omega);
  const std::complex<double> z = std::polar(std::pow(std::abs(omega) * solid.creep_time, solid.order), angle);
  const double glassy = 1 + solid.stiffening;
  return solid.static_modulus * glassy * (1.0 + z) / (glassy + z);
}

CreepSpectrum creep_spectrum(const FractionalZener& solid) {
  if (solid.stiffening == 0 || solid.creep_time == 0) return {.instantaneous = 1 / solid.static_modulus, .terms = {}};
  const double glassy = 1 / (solid.static_modulus * (1 + solid.stiffening));
  CreepSpectrum creep{.instantaneous = glassy, .terms = {}};
  if (solid.order == 1) {
    creep.terms.push_back({solid.stiffening * glassy, solid.creep_time});
    return creep;
  }
  // cosh(order s) + cos(pi order) = 2 (sinh^2(order s/2) + cos^2(pi order/2)), without cancellation near order 1.
  const double order = solid.order, to_one = 0.5 * std::numbers::pi * (1 - order);
  const auto density = [&](double s) {
    const double wide = std::sinh(0.5 * order * s), narrow = std::sin(to_one);
    return std::sin(2 * to_one) / (4 * std::numbers::pi * (wide * wide + narrow * narrow));
  };
  const Stretching stretching{2 * to_one / order};
  // Up to where either what is left out is small, or its times are beyond all frequencies.
  constexpr double decades = 12 * 2.302585, margin = 9;
  const double reach = std::min(18.4 / order, decades + margin);
  const int count = checked_count(std::ceil(stretching.u(reach) / step), "retardation times");
  double sum = 0;
  for (int i = -count; i <= count; ++i) {
    const double s = stretching.s(i * step), weight = step * density(s) / stretching.slope(s);
    creep.terms.push_back({weight, solid.creep_time * std::exp(s)});
    sum += weight;
  }
  // The rule has the whole weight but for the tails: the short one is instantaneous, the long one at rest.
  const double tail = std::max(0.0, 0.5 * (1 - sum));
  const double whole = std::max(1.0, sum);
  for (CreepSpectrum::Term& term : creep.terms) term.compliance *= solid.stiffening * glassy / whole;
  creep.instantaneous += tail * solid.stiffening * glassy;
  creep.terms.back().compliance += tail * solid.stiffening * glassy;
  return creep;
}

}  // namespace rollres
