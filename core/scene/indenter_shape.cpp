#include "core/scene/indenter_shape.hpp"

namespace rollres {

LeverArm IndenterShape::load(double x, double y) const {
  if (!flat_in_y_) return {1, 0};
  return {height(x, y) / radius_, -x / radius_};
}

LeverArm IndenterShape::driving_force(double x, double y) const {
  if (!flat_in_y_) return {0, 1};
  return {x / radius_, height(x, y) / radius_};
}

LeverArm IndenterShape::torque(double x, double y) const {
  if (!flat_in_y_) return {x, -height(x, y)};
  return {0, -radius_};
}

LeverArm IndenterShape::unbalanced_power(double omega, double x, double y) const {
  const LeverArm force = driving_force(x, y), turning = torque(x, y);
  return {force.of_pressure + omega * turning.of_pressure / radius_ - slope(x, y),
          force.of_shear_x + omega * (turning.of_shear_x / radius_ + rolling_radius(y)) - 1};
}

}  // namespace rollres
