#include "core/reference/reference_hunter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/messages/require.hpp"
#include "core/numerics/bracketed_root.hpp"
#include "core/numerics/memory_functions.hpp"
#include "core/numerics/quadrature.hpp"

namespace rollres {
namespace {

using std::numbers::pi;

/// The two ratios and what follows from them at a half-width l.
struct Hunter {
  double i1, i2, k1;  // I1/I0 and I2/I0 at l/T_r, K1/K0 at l/T
  double centre;      // equation (1)
  double load;        // equation (2) over pi E0*/4R

  Hunter(double l, double creep_length, double relaxation_length) {
    const auto finite = [](double x) { return std::min(x, 1e30); };  // the limit, to all digits
    const Eigen::VectorXd i = scaled_bessel_i(finite(l / relaxation_length), 3);
    const ScaledBesselK k = scaled_bessel_k(finite(l / creep_length));
    i1 = i(1) / i(0);
    i2 = i(2) / i(0);
    k1 = k.order_1 / k.order_0;
    centre = (creep_length - relaxation_length) * i1 / (i1 + k1);
    load = l * (l + 2 * centre * k1);
  }
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
  const QuadratureRule& rule = gauss_rule(20);
  double sum = 0, start = 0;
  for (int panel = 1; panel <= 20 && start < angle; ++panel) {
    const double next = s + 2 * panel * t;
    const double end = next < 1 ? std::max(start, angle - std::acos(next)) : angle;
    for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
      const double distance = start + (end - start) * rule.nodes[k];
      const double decay = 2 / t * std::sin(angle - distance / 2) * std::sin(distance / 2);
      sum += (end - start) * rule.weights[k] * smooth_source(line, std::cos(angle - distance)) * std::exp(-decay);
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
