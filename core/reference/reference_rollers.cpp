#include "core/reference/reference_rollers.hpp"

#include <cmath>
#include <complex>

#include "core/messages/require.hpp"

namespace rollres {
namespace {

struct RollerContact {
  double half_width;  // a0 [m]
  double kappa;       // [1]
};

RollerContact roller_contact(double radius, double load, double shear_modulus, double poisson_ratio) {
  require_positive("radius", radius);
  require_positive("load", load);
  require_positive("shear_modulus", shear_modulus);
  require(poisson_ratio >= 0 && poisson_ratio <= 0.5, "poisson_ratio", poisson_ratio, "must be from 0 to 0.5");
  const double half_width = std::sqrt(2 * (1 - poisson_ratio) * load * radius / (M_PI * shear_modulus));
  return {half_width, (1 - 2 * poisson_ratio) / (1 - poisson_ratio)};
}

/// Share c of the half-width within which half of Hertz's load acts, (2/pi)(c sqrt(1 - c^2) + asin(c)) = 1/2.
double half_load_share() {
  double c = 0.4;
  for (int i = 0; i < 5; ++i) {
    const double root = std::sqrt(1 - c * c);
    c -= (c * root + std::asin(c) - 0.25 * M_PI) / (2 * root);
  }
  return c;
}

std::complex<double> roller_traction(const NoSlipLine& line, double x) {
  const double s = x / line.half_width;
  if (std::abs(s) >= 1) return 0;
  return std::polar(line.mid_pressure * std::sqrt((1 - s) * (1 + s)), 2 * line.exponent * std::atanh(s));
}

}  // namespace

FullSlipLine full_slip_line(double radius, double load, double shear_modulus, double poisson_ratio,
                            double friction_coefficient) {
  const auto [half_width, kappa] = roller_contact(radius, load, shear_modulus, poisson_ratio);
  require(poisson_ratio < 0.5, "poisson_ratio", poisson_ratio, "must be below 0.5: nothing slips there");
  require_positive("friction_coefficient", friction_coefficient);
  const double c = half_load_share(), scale = kappa * half_width / (2 * radius);
  // (2/pi) int (1 - s^2) ds inside less outside; the creepage takes nothing, as both carry the same load.
  const double loss = 8 / M_PI * (c - c * c * c / 3 - 1.0 / 3);
  return {half_width, c * half_width, scale * std::sqrt(1 - c * c), friction_coefficient * load * scale * loss};
}

double NoSlipLine::pressure(double x) const { return roller_traction(*this, x).real(); }
double NoSlipLine::shear(double x) const { return roller_traction(*this, x).imag(); }

NoSlipLine no_slip_line(double radius, double load, double shear_modulus, double poisson_ratio) {
  const auto [hertz_width, kappa] = roller_contact(radius, load, shear_modulus, poisson_ratio);
  const double eta = std::atanh(0.5 * kappa) / M_PI, half_width = hertz_width / std::sqrt(1 + 4 * eta * eta);
  return {half_width, eta, 2 * eta * half_width / radius,
          2 * load * std::cosh(M_PI * eta) * half_width / (M_PI * hertz_width * hertz_width)};
}

}  // namespace rollres
