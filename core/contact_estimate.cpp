#include "core/contact_estimate.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

namespace rollres {
namespace {

using std::numbers::pi;

constexpr int knots = 7;
using Row = std::array<double, knots>;
constexpr Row tabulated_alpha{0.1, 0.3, 0.5, 1, 2, 5, 20};
constexpr Row sphere_load{5.33761, 5.43854, 5.75417, 7.52267, 13.8566, 53.0469, 1195.77};       // P R / (G a^3)
constexpr Row sphere_flatness{1.08018, 1.25871, 1.43627, 1.78758, 2.19827, 2.78455, 3.52642};   // a^2 / (R d)
constexpr Row cylinder_load{1.01022, 1.09106, 1.24748, 1.90330, 4.04782, 18.2833, 482.233};     // P R / (pi G a^2)
constexpr Row cylinder_approach{1.2738, 0.78789, 0.60903, 0.43831, 0.33225, 0.24707, 0.18996};  // d R / a^2

/// Cubic spline of ln(value) over ln(alpha), with the slopes d ln(value) / d ln(alpha) at both ends given.
class LogSpline {
 public:
  LogSpline(const Row& values, double first_slope, double last_slope) {
    for (int i = 0; i < knots; ++i) {
      s_[i] = std::log(tabulated_alpha[i]);
      y_[i] = std::log(values[i]);
    }
    // Continuity of the second derivative at the inner knots: a tridiagonal system for the slopes.
    Row diagonal, right;
    slope_.front() = first_slope;
    slope_.back() = last_slope;
    for (int i = 1; i < knots - 1; ++i) {
      const double h0 = s_[i] - s_[i - 1], h1 = s_[i + 1] - s_[i];
      diagonal[i] = 2 * (h0 + h1);
      right[i] = 3 * (h1 * (y_[i] - y_[i - 1]) / h0 + h0 * (y_[i + 1] - y_[i]) / h1);
      if (i == 1) {
        right[i] -= h1 * first_slope;
      } else {
        const double factor = h1 / diagonal[i - 1];
        diagonal[i] -= factor * (s_[i - 1] - s_[i - 2]);
        right[i] -= factor * right[i - 1];
      }
    }
    for (int i = knots - 2; i >= 1; --i) slope_[i] = (right[i] - (s_[i] - s_[i - 1]) * slope_[i + 1]) / diagonal[i];
  }

  double operator()(double alpha) const {
    const double s = std::log(alpha);
    int i = 0;
    while (i < knots - 2 && s > s_[i + 1]) ++i;
    const double h = s_[i + 1] - s_[i], t = (s - s_[i]) / h;
    const double value = (1 + 2 * t) * (1 - t) * (1 - t) * y_[i] + t * t * (3 - 2 * t) * y_[i + 1] +
                         h * t * (1 - t) * ((1 - t) * slope_[i] - t * slope_[i + 1]);
    return std::exp(value);
  }

 private:
  Row s_, y_, slope_;
};

constexpr double thick = tabulated_alpha.front(), thin = tabulated_alpha.back();

// Thin layer: value = limit (1 + b/alpha)^power, b such that it meets the last knot.
double thin_offset(double last_value, double limit, double power) {
  return thin * (std::pow(last_value / limit, 1 / power) - 1);
}
double thin_slope(double offset, double power) { return -power * offset / (thin + offset); }

/// P R / (G a^3)
double sphere_load_number(double alpha) {
  static const double limit = pi / 32;  // times alpha^3
  static const double quotient = sphere_load.back() / (thin * thin * thin);
  static const double offset = thin_offset(quotient, limit, 6);
  static const double cubic = (sphere_load.front() - 16.0 / 3) / (thick * thick * thick);
  static const LogSpline spline(sphere_load, 3 * cubic * thick * thick * thick / sphere_load.front(),
                                3 + thin_slope(offset, 6));
  if (alpha < thick) return 16.0 / 3 + cubic * alpha * alpha * alpha;
  if (alpha > thin) return limit * alpha * alpha * alpha * std::pow(1 + offset / alpha, 6);
  return spline(alpha);
}

/// d R / a^2
double sphere_approach_number(double alpha) {
  static const double offset = thin_offset(1 / sphere_flatness.back(), 0.25, 2);
  static const double linear = (sphere_flatness.front() - 1) / thick;
  static const LogSpline spline(sphere_flatness, linear * thick / sphere_flatness.front(), -thin_slope(offset, 2));
  if (alpha < thick) return 1 / (1 + linear * alpha);
  if (alpha > thin) return 0.25 * std::pow(1 + offset / alpha, 2);
  return 1 / spline(alpha);
}

/// P R / (pi G a^2)
double cylinder_load_number(double alpha) {
  static const double limit = 2 / (15 * pi);  // times alpha^3
  static const double quotient = cylinder_load.back() / (thin * thin * thin);
  static const double offset = thin_offset(quotient, limit, 5);
  static const double square = (cylinder_load.front() - 1) / (thick * thick);
  static const LogSpline spline(cylinder_load, 2 * square * thick * thick / cylinder_load.front(),
                                3 + thin_slope(offset, 5));
  if (alpha < thick) return 1 + square * alpha * alpha;
  if (alpha > thin) return limit * alpha * alpha * alpha * std::pow(1 + offset / alpha, 5);
  return spline(alpha);
}

/// d R / a^2
double cylinder_approach_number(double alpha) {
  static const double offset = thin_offset(cylinder_approach.back(), 1.0 / 6, 2);
  // Thick layer: d R / a^2 = ln(1/alpha)/2 + constant, from the deflection under a line load on the layer.
  static const double constant = cylinder_approach.front() + std::log(thick) / 2;
  static const LogSpline spline(cylinder_approach, -0.5 / cylinder_approach.front(), thin_slope(offset, 2));
  if (alpha < thick) return constant - std::log(alpha) / 2;
  if (alpha > thin) return std::pow(1 + offset / alpha, 2) / 6;
  return spline(alpha);
}

void require_positive(const char* name, double value, bool infinity_allowed = false) {
  if (!(value > 0) || (!infinity_allowed && std::isinf(value)))
    throw std::invalid_argument(std::string(name) + " = " + std::to_string(value) + ": must be > 0");
}

/// alpha at which the increasing function alpha^power number(alpha) takes the given value.
template <class Number>
double find_alpha(Number number, int power, double value) {
  const auto excess = [&](double log_alpha) {
    return power * log_alpha + std::log(number(std::exp(log_alpha))) - std::log(value);
  };
  double low = 0, high = 0;
  for (double step = 1; excess(low) > 0; step *= 2) low -= step;
  for (double step = 1; excess(high) < 0; step *= 2) high += step;
  while (high - low > 1e-13 * (1 + std::abs(low))) {
    const double middle = low + (high - low) / 2;
    (excess(middle) < 0 ? low : high) = middle;
  }
  return std::exp(low + (high - low) / 2);
}

double load_scale(Indenter indenter, double shear_modulus) {
  return indenter == Indenter::sphere ? shear_modulus : pi * shear_modulus;
}

}  // namespace

ContactEstimate elastic_contact_from_load(Indenter indenter, double radius, double layer_thickness,
                                          double shear_modulus, double load) {
  require_positive("radius", radius);
  require_positive("layer_thickness", layer_thickness, true);
  require_positive("shear_modulus", shear_modulus);
  require_positive("load", load);
  const bool sphere = indenter == Indenter::sphere;
  const double number = load * radius / load_scale(indenter, shear_modulus);  // a^n f, n = 3 (sphere) or 2
  if (std::isinf(layer_thickness)) {
    const double a = sphere ? std::cbrt(3.0 / 16 * number) : std::sqrt(number);
    return {a, sphere ? a * a / radius : std::numeric_limits<double>::quiet_NaN(), load};
  }
  const double h = layer_thickness;
  const double alpha = sphere ? find_alpha(sphere_load_number, 3, number / (h * h * h))
                              : find_alpha(cylinder_load_number, 2, number / (h * h));
  const double a = alpha * h;
  return {a, a * a / radius * (sphere ? sphere_approach_number(alpha) : cylinder_approach_number(alpha)), load};
}

ContactEstimate elastic_contact_from_approach(Indenter indenter, double radius, double layer_thickness,
                                              double shear_modulus, double approach) {
  require_positive("radius", radius);
  require_positive("layer_thickness", layer_thickness, true);
  require_positive("shear_modulus", shear_modulus);
  require_positive("approach", approach);
  const bool sphere = indenter == Indenter::sphere;
  const double scale = load_scale(indenter, shear_modulus) / radius;
  if (std::isinf(layer_thickness)) {
    if (!sphere)
      throw std::invalid_argument(
          "approach: a cylinder on a half-space has no approach (layer_thickness is infinite); give a load");
    const double a = std::sqrt(approach * radius);
    return {a, approach, scale * 16 / 3 * a * a * a};
  }
  const double h = layer_thickness, number = approach * radius / (h * h);
  const double alpha =
      sphere ? find_alpha(sphere_approach_number, 2, number) : find_alpha(cylinder_approach_number, 2, number);
  const double a = alpha * h;
  return {a, approach, scale * a * a * (sphere ? a * sphere_load_number(alpha) : cylinder_load_number(alpha))};
}

}  // namespace rollres
