#include "core/estimate/contact_estimate.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "core/messages/message_text.hpp"
#include "core/messages/require.hpp"
#include "core/numerics/bracketed_root.hpp"
#include "core/reference/reference_solutions.hpp"

namespace rollres {
namespace {

using std::numbers::pi;

constexpr int knots = static_cast<int>(elastic_layer_table.size());
using Row = std::array<double, knots>;

Row column(double ElasticLayerRow::*member) {
  Row values{};
  for (int i = 0; i < knots; ++i) values[i] = elastic_layer_table[i].*member;
  return values;
}

/// Cubic spline of ln(value) over ln(alpha), with the slopes d ln(value) / d ln(alpha) at both ends given.
class LogSpline {
 public:
  LogSpline(const Row& values, double first_slope, double last_slope) {
    for (int i = 0; i < knots; ++i) {
      s_[i] = std::log(elastic_layer_table[i].width_ratio);
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

constexpr double thick = elastic_layer_table.front().width_ratio, thin = elastic_layer_table.back().width_ratio;

// Thin layer: value = limit (1 + b/alpha)^power, b such that it meets the last knot.
double thin_offset(double last_value, double limit, double power) {
  return thin * (std::pow(last_value / limit, 1 / power) - 1);
}
double thin_slope(double offset, double power) { return -power * offset / (thin + offset); }

/// P R / (G a^3)
double sphere_load_number(double alpha) {
  static const double limit = pi / 32;  // times alpha^3
  static const double quotient = elastic_layer_table.back().sphere_load / (thin * thin * thin);
  static const double offset = thin_offset(quotient, limit, 6);
  static const double cubic = (elastic_layer_table.front().sphere_load - 16.0 / 3) / (thick * thick * thick);
  static const LogSpline spline(column(&ElasticLayerRow::sphere_load),
                                3 * cubic * thick * thick * thick / elastic_layer_table.front().sphere_load,
                                3 + thin_slope(offset, 6));
  if (alpha < thick) return 16.0 / 3 + cubic * alpha * alpha * alpha;
  if (alpha > thin) return limit * alpha * alpha * alpha * std::pow(1 + offset / alpha, 6);
  return spline(alpha);
}

/// d R / a^2
double sphere_approach_number(double alpha) {
  static const double offset = thin_offset(1 / elastic_layer_table.back().sphere_flatness, 0.25, 2);
  static const double linear = (elastic_layer_table.front().sphere_flatness - 1) / thick;
  static const LogSpline spline(column(&ElasticLayerRow::sphere_flatness),
                                linear * thick / elastic_layer_table.front().sphere_flatness, -thin_slope(offset, 2));
  if (alpha < thick) return 1 / (1 + linear * alpha);
  if (alpha > thin) return 0.25 * std::pow(1 + offset / alpha, 2);
  return 1 / spline(alpha);
}

/// P R / (pi G a^2)
double cylinder_load_number(double alpha) {
  static const double limit = 2 / (15 * pi);  // times alpha^3
  static const double quotient = elastic_layer_table.back().cylinder_load / (thin * thin * thin);
  static const double offset = thin_offset(quotient, limit, 5);
  static const double square = (elastic_layer_table.front().cylinder_load - 1) / (thick * thick);
  static const LogSpline spline(column(&ElasticLayerRow::cylinder_load),
                                2 * square * thick * thick / elastic_layer_table.front().cylinder_load,
                                3 + thin_slope(offset, 5));
  if (alpha < thick) return 1 + square * alpha * alpha;
  if (alpha > thin) return limit * alpha * alpha * alpha * std::pow(1 + offset / alpha, 5);
  return spline(alpha);
}

/// d R / a^2
double cylinder_approach_number(double alpha) {
  static const double offset = thin_offset(elastic_layer_table.back().cylinder_approach, 1.0 / 6, 2);
  // Thick layer: d R / a^2 = ln(1/alpha)/2 + constant, from the deflection under a line load on the layer.
  static const double constant = elastic_layer_table.front().cylinder_approach + std::log(thick) / 2;
  static const LogSpline spline(column(&ElasticLayerRow::cylinder_approach),
                                -0.5 / elastic_layer_table.front().cylinder_approach, thin_slope(offset, 2));
  if (alpha < thick) return constant - std::log(alpha) / 2;
  if (alpha > thin) return std::pow(1 + offset / alpha, 2) / 6;
  return spline(alpha);
}

/// alpha at which the increasing function alpha^power number(alpha) takes the given value.
/// @param given  the load or the approach that it answers   @throws std::domain_error naming that
template <class Number>
double find_alpha(Number number, int power, double value, std::string_view name, double given) {
  const auto excess = [&](double log_alpha) {
    return power * log_alpha + std::log(number(std::exp(log_alpha))) - std::log(value);
  };
  double low = 0, high = 0;
  constexpr double farthest = 2e3;
  for (double step = 1; step < farthest && excess(low) > 0; step *= 2) low -= step;
  for (double step = 1; step < farthest && excess(high) < 0; step *= 2) high += step;
  const std::optional<double> logarithm = root_between(excess, low, high);
  if (!logarithm) throw std::domain_error(no_half_width(name, given));
  return std::exp(*logarithm);
}

/// The two numbers of a layer, for a modulus of G: they contain what Poisson's ratio changes.
class ContactNumbers {
 public:
  ContactNumbers(int dimension, const Layer& layer)
      : sphere_(dimension == 3), layered_(!std::isinf(layer.thickness)), nu_(layer.poisson_ratio) {}

  /// P R / (G a^3), or P R / (G a^2) for a cylinder
  double load(double alpha) const {
    if (!layered_) return deep();
    return deep() + confined(alpha) * share_of_shear(alpha);
  }
  /// d R / a^2
  double approach(double alpha) const {
    if (!layered_) return 1;
    const double incompressible = sphere_ ? sphere_approach_number(alpha) : cylinder_approach_number(alpha);
    if (nu_ == 0.5) return incompressible;
    const double by_base = confined(alpha) / (deep() + confined(alpha));
    const double foundation = by_base * (1 - share_of_shear(alpha));  // d = a^2/2R there
    return incompressible + foundation * (0.5 - incompressible);
  }

 private:
  double deep() const { return (sphere_ ? 16.0 / 3 : pi) / (2 * (1 - nu_)); }
  /// What the base adds to the load on an incompressible layer.
  double confined(double alpha) const {
    return sphere_ ? sphere_load_number(alpha) - 16.0 / 3 : pi * (cylinder_load_number(alpha) - 1);
  }
  /// The part of it that is left where the layer yields in volume too: 1 for nu = 1/2.
  double share_of_shear(double alpha) const {
    if (nu_ == 0.5) return 1;
    const double modulus = 2 * (1 - nu_) / (1 - 2 * nu_);  // of the foundation, times H/G
    const double foundation = modulus * (sphere_ ? pi / 4 : 2.0 / 3) * alpha;
    return foundation / (foundation + confined(alpha));
  }

  bool sphere_, layered_;
  double nu_;
};

}  // namespace

std::string no_half_width(std::string_view given, double value) {
  return message_text<6>(
      given, " = ", value,
      ": no contact of any half-width answers it with the radius, the moduli and the thicknesses that are given");
}

ContactEstimate elastic_contact_from_load(int dimension, double radius, const Layer& layer, double shear_modulus,
                                          double load) {
  require_positive("radius", radius);
  require_positive_or_infinite("layer_thickness", layer.thickness);
  require_positive("shear_modulus", shear_modulus);
  require_positive("load", load);
  const bool sphere = dimension == 3;
  const ContactNumbers numbers(dimension, layer);
  const double scaled = load * radius / shear_modulus;  // a^n f, n = 3 (sphere) or 2
  if (std::isinf(layer.thickness)) {
    const double a = sphere ? std::cbrt(scaled / numbers.load(0)) : std::sqrt(scaled / numbers.load(0));
    return {a, sphere ? a * a / radius : std::numeric_limits<double>::quiet_NaN(), load};
  }
  const double h = layer.thickness;
  const int power = sphere ? 3 : 2;
  const double alpha = find_alpha([&](double at) { return numbers.load(at); }, power,
                                  scaled / (sphere ? h * h * h : h * h), "load", load);
  const double a = alpha * h;
  return {a, a * a / radius * numbers.approach(alpha), load};
}

ContactEstimate elastic_contact_from_approach(int dimension, double radius, const Layer& layer, double shear_modulus,
                                              double approach) {
  require_positive("radius", radius);
  require_positive_or_infinite("layer_thickness", layer.thickness);
  require_positive("shear_modulus", shear_modulus);
  require_positive("approach", approach);
  const bool sphere = dimension == 3;
  const ContactNumbers numbers(dimension, layer);
  const double scale = shear_modulus / radius;
  if (std::isinf(layer.thickness)) {
    if (!sphere)
      throw std::invalid_argument(
          "approach: a cylinder on a half-space has no approach (layer_thickness is infinite); give a load");
    const double a = std::sqrt(approach * radius);
    return {a, approach, scale * numbers.load(0) * a * a * a};
  }
  const double h = layer.thickness;
  const double alpha =
      find_alpha([&](double at) { return numbers.approach(at); }, 2, approach * radius / (h * h), "approach", approach);
  const double a = alpha * h;
  return {a, approach, scale * a * a * (sphere ? a : 1) * numbers.load(alpha)};
}

}  // namespace rollres
