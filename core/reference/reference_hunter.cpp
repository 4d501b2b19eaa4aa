#include "core/reference/reference_hunter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/messages/require.hpp"
#include "core/numerics/bracketed_root.hpp"

namespace rollres {
namespace {

using std::numbers::pi;

// The functions of the standard library overflow near 700; beyond this argument Hankel's expansion has all digits.
constexpr double large = 100;

/// sum_k (+-1)^k a_k(order)/x^k of I (alternating) or K, without exp(+-x) and sqrt: Abramowitz and Stegun 9.7.1, 9.7.2.
double hankel_sum(int order, double x, bool alternating) {
  double sum = 1, term = 1;
  for (int k = 1; k < 12; ++k) {
    term *= (4.0 * order * order - (2 * k - 1) * (2 * k - 1)) / (8 * k * x) * (alternating ? -1 : 1);
    sum += term;
  }
  return sum;
}

/// I_order(x) / I_0(x)
double bessel_i_ratio(int order, double x) {
  if (x > large) return hankel_sum(order, x, true) / hankel_sum(0, x, true);
  return std::cyl_bessel_i(order, x) / std::cyl_bessel_i(0, x);
}

/// K_1(x) / K_0(x)
double bessel_k_ratio(double x) {
  if (x > large) return hankel_sum(1, x, false) / hankel_sum(0, x, false);
  return std::cyl_bessel_k(1, x) / std::cyl_bessel_k(0, x);
}

constexpr int points = 20;
struct GaussRule {
  std::array<double, points> nodes, weights;  // on [-1, 1]
};

/// Gauss-Legendre rule: Newton's method from Tricomi's estimate of the roots.
const GaussRule& gauss_rule() {
  static const GaussRule rule = [] {
    GaussRule r{};
    for (int k = 0; k < points; ++k) {
      double x = std::cos(pi * (k + 0.75) / (points + 0.5)), slope = 1;
      for (int step = 0; step < 6; ++step) {
        const double value = std::legendre(points, x);
        slope = points * (x * value - std::legendre(points - 1, x)) / (x * x - 1);
        x -= value / slope;
      }
      r.nodes[k] = x;
      r.weights[k] = 2 / ((1 - x * x) * slope * slope);
    }
    return r;
  }();
  return rule;
}

/// The two ratios and what follows from them at a half-width l.
struct Hunter {
  double i1, i2, k1;  // I1/I0 and I2/I0 at l/T_r, K1/K0 at l/T
  double centre;      // equation (1)
  double load;        // equation (2) over pi E0*/4R

  Hunter(double l, double creep_length, double relaxation_length)
      : i1(bessel_i_ratio(1, l / relaxation_length)),
        i2(bessel_i_ratio(2, l / relaxation_length)),
        k1(bessel_k_ratio(l / creep_length)),
        centre((creep_length - relaxation_length) * i1 / (i1 + k1)),
        load(l * (l + 2 * centre * k1)) {}
};

/// q(s) sqrt(1 - s^2) over E0*/2R [m] at s = cos(angle).
double smooth_source(const HunterLine& line, double cosine) {
  return line.half_width * (1 - cosine * cosine) + (line.creep_length - line.centre) * cosine + line.edge_term;
}

/// p over E0*/2R at s = cos(angle), equation (4) with s' = cos(angle'), where the integrand has no singularity.
double scaled_pressure(const HunterLine& line, double angle) {
  const double t = line.relaxation_length / line.half_width;
  if (t == 0) return line.half_width * std::sin(angle);
  // In the distance from `angle`, panels over which the exponent falls by at most 2; nothing is left beyond 40.
  const double s = std::cos(angle);
  const GaussRule& rule = gauss_rule();
  double sum = 0, start = 0;
  for (int panel = 1; panel <= 20 && start < angle; ++panel) {
    const double next = s + 2 * panel * t;
    const double end = next < 1 ? std::max(start, angle - std::acos(next)) : angle;
    const double half = (end - start) / 2, middle = (end + start) / 2;
    for (int k = 0; k < points; ++k) {
      const double distance = middle + half * rule.nodes[k];
      const double decay = 2 / t * std::sin(angle - distance / 2) * std::sin(distance / 2);
      sum += half * rule.weights[k] * smooth_source(line, std::cos(angle - distance)) * std::exp(-decay);
    }
    start = end;
  }
  return sum / t;
}

/// t dp/ds = p - q, from differentiating (4), times sin(angle) and over E0*/2R.
double scaled_slope(const HunterLine& line, double angle) {
  return scaled_pressure(line, angle) * std::sin(angle) - smooth_source(line, std::cos(angle));
}

double peak_of(const HunterLine& line) {
  if (line.creep_length < 1e-12 * line.half_width) return line.half_width;  // Hertz
  // A stiffening layer has a second, thin hump at the leading edge (angle 0), as wide as the relaxation length.
  const double hump = std::sqrt(2 * line.relaxation_length / line.half_width), widest = pi / 64;
  double before = 0, angle = std::min(hump, 1.0) / 64, low = 0, high = angle, highest = 0;
  while (angle < pi) {
    const double next = angle + std::min(0.2 * angle, widest), value = scaled_pressure(line, angle);
    if (value > highest) highest = value, low = before, high = std::min(next, pi);
    before = angle;
    angle = next;
  }
  const auto slope = [&](double at) { return scaled_slope(line, at); };
  if (!(slope(low) < 0 && slope(high) > 0)) return highest;  // p - q is lost in rounding
  return std::max(highest, scaled_pressure(line, bracketed_root(slope, low, high, 1e-9)));
}

}  // namespace

double HunterLine::pressure(double x) const {
  const double s = (x - centre) / half_width;
  if (!(std::abs(s) < 1)) return 0;
  return stress_scale * scaled_pressure(*this, std::acos(s));
}

HunterLine hunter_line(double radius, double load, double static_shear_modulus, double stiffening, double creep_time,
                       double speed) {
  require_positive("radius", radius);
  require_positive("load", load);
  require_positive("static_shear_modulus", static_shear_modulus);
  require_not_negative("stiffening", stiffening);
  require_not_negative("creep_time", creep_time);
  require_positive("speed", speed);

  const double modulus = 4 * static_shear_modulus;  // E0*
  const double creep_length = speed * creep_time, relaxation_length = creep_length / (1 + stiffening);
  const double wanted = 4 * radius * load / (pi * modulus);  // square of the rubbery Hertz half-width
  const auto at = [&](double l) { return Hunter(l, creep_length, relaxation_length); };
  const double rubbery = std::sqrt(wanted), glassy = rubbery / std::sqrt(1 + stiffening);
  const double l = bracketed_root([&](double width) { return at(width).load - wanted; }, glassy * (1 - 1e-12),
                                  rubbery * (1 + 1e-12));
  const Hunter h = at(l);

  HunterLine line{};
  line.half_width = l;
  line.centre = h.centre;
  line.stress_scale = modulus / (2 * radius);
  line.creep_length = creep_length;
  line.relaxation_length = relaxation_length;
  line.edge_term = h.centre * h.k1;
  // Equation (3) with (1) and (2) put in and 1 - (2/y) I1/I0 = I2/I0, so that no two terms cancel.
  const double moment = pi * modulus * l * l / (4 * radius) * (creep_length - relaxation_length) / (h.i1 + h.k1) *
                        (h.i1 + h.k1 * h.i2 + 2 * h.i1 * h.k1 * h.centre / l);
  line.rolling_resistance = moment / radius;
  line.peak_pressure = line.stress_scale * peak_of(line);
  return line;
}

}  // namespace rollres
