#include "core/reference/reference_solutions.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "core/messages/require.hpp"

namespace rollres {
namespace {

using std::numbers::pi;

/// sqrt(1 - (x/half_width)^2), 0 outside.
double ellipse(double x, double half_width) {
  const double s = x / half_width;
  return std::abs(s) < 1 ? std::sqrt((1 - s) * (1 + s)) : 0;
}

void require_body(double radius, double load, double shear_modulus) {
  require_positive("radius", radius);
  require_positive("load", load);
  require_positive("shear_modulus", shear_modulus);
}

}  // namespace

double HertzLine::pressure(double x) const { return peak_pressure * ellipse(x, half_width); }
double HertzSphere::pressure(double r) const { return peak_pressure * ellipse(r, half_width); }

HertzLine hertz_line(double radius, double load, double shear_modulus) {
  require_body(radius, load, shear_modulus);
  const double a = std::sqrt(load * radius / (pi * shear_modulus));
  return {a, 2 * load / (pi * a)};
}

HertzSphere hertz_sphere(double radius, double load, double shear_modulus) {
  require_body(radius, load, shear_modulus);
  const double a = std::cbrt(3 * load * radius / (16 * shear_modulus));
  return {a, a * a / radius, 3 * load / (2 * pi * a * a)};
}

double ThinLayerContact::pressure(double x) const {
  const double root = ellipse(x, half_width);
  return peak_pressure * root * root * root * root;
}

ThinLayerContact thin_layer_line(double radius, double layer_thickness, double load, double shear_modulus) {
  require_body(radius, load, shear_modulus);
  require_positive("layer_thickness", layer_thickness);
  const double a = std::pow(7.5 * load * radius * std::pow(layer_thickness, 3) / shear_modulus, 0.2);
  return {a, a * a / (6 * radius), 15 * load / (16 * a), a * a / 7};
}

ThinLayerContact thin_layer_sphere(double radius, double layer_thickness, double load, double shear_modulus) {
  require_body(radius, load, shear_modulus);
  require_positive("layer_thickness", layer_thickness);
  const double a = std::pow(32 * load * radius * std::pow(layer_thickness, 3) / (pi * shear_modulus), 1.0 / 6);
  return {a, a * a / (4 * radius), 3 * load / (pi * a * a), a * a / 4};
}

double slow_loss_time(double stiffening, double creep_time) {
  require_not_negative("stiffening", stiffening);
  require_not_negative("creep_time", creep_time);
  return stiffening * creep_time / (1 + stiffening);
}

double fast_loss_time(double stiffening, double creep_time) {
  require_not_negative("stiffening", stiffening);
  require_positive("creep_time", creep_time);
  return stiffening == 0 ? std::numeric_limits<double>::infinity() : creep_time / stiffening;
}

double slow_rolling_resistance(double load, double radius, double speed, double loss_time) {
  require_positive("load", load);
  require_positive("radius", radius);
  require_positive("speed", speed);
  require_not_negative("loss_time", loss_time);
  return load * speed * loss_time / radius;
}

double fast_rolling_resistance(double load, double approach, double mean_square_position, double radius, double speed,
                               double loss_time) {
  require_positive("load", load);
  require_positive("approach", approach);
  require_not_negative("mean_square_position", mean_square_position);
  require_positive("radius", radius);
  require_positive("speed", speed);
  require_positive_or_infinite("loss_time", loss_time);
  return load * (approach - mean_square_position / (2 * radius)) / (speed * loss_time);
}

ConstantLossCoefficients constant_loss_coefficients() {
  return {8 / (3 * pi), 6 / (pi * pi), 5 / (6 * pi), 96 / (35 * pi * pi)};
}

double CarterLine::shear(double x) const {
  // The full slip of the whole contact less the same, smaller, on the stick zone beside the leading edge.
  const double ratio = stick_half_width / half_width;
  return -sign * limit_pressure *
         (ellipse(x, half_width) - ratio * ellipse(x - (half_width - stick_half_width), stick_half_width));
}

CarterLine carter_line(double radius, double load, double shear_modulus, double friction_coefficient, double torque) {
  const HertzLine hertz = hertz_line(radius, load, shear_modulus);
  require_positive("friction_coefficient", friction_coefficient);
  const double force = torque / radius, used = force / (friction_coefficient * load);
  require(std::abs(used) < 1, "torque", torque, "must be smaller than friction_coefficient times load times radius");
  CarterLine line{};
  line.half_width = hertz.half_width;
  line.stick_half_width = hertz.half_width * std::sqrt(1 - std::abs(used));
  line.sign = used > 0 ? 1 : used < 0 ? -1 : 0;
  // a - a' = a |used| / (1 + sqrt(1 - |used|)), without cancellation for a small torque
  const double slip_width = hertz.half_width * std::abs(used) / (1 + std::sqrt(1 - std::abs(used)));
  line.creepage = line.sign * friction_coefficient * slip_width / radius;
  line.tangential_force = force;
  line.rolling_resistance = force * line.creepage;
  line.limit_pressure = friction_coefficient * hertz.peak_pressure;
  return line;
}

KalkerCoefficients kalker_circle(double poisson_ratio) {
  if (poisson_ratio == 0.5) return {5.20, 3.98, 1.63};
  require(poisson_ratio == 0.25, "poisson_ratio", poisson_ratio, "must be 0.25 or 0.5, the values tabulated");
  return {4.12, 3.67, 1.47};
}

double kalker_force(double half_width, double shear_modulus, double creepage) {
  require_positive("half_width", half_width);
  require_positive("shear_modulus", shear_modulus);
  require(std::isfinite(creepage), "creepage", creepage, "must be a number");
  return 2 * shear_modulus * half_width * half_width * kalker_circle(0.5).c11 * creepage;
}

}  // namespace rollres
