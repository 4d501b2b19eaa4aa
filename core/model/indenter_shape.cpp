#include "core/model/indenter_shape.hpp"

namespace rollres {

LeverArm IndenterShape::load(double x, double y) const {
  if (kinematics_ == Kinematics::consistent || !flat_in_y_) return {.of_pressure = 1};
  return {.of_pressure = height(x, y) / radius_, .of_shear_x = -x / radius_};
}

LeverArm IndenterShape::driving_force(double x, double y) const {
  if (kinematics_ == Kinematics::consistent) return {.of_pressure = slope(x, y), .of_shear_x = slip(x, y).forward};
  if (!flat_in_y_) return {.of_shear_x = 1};
  return {.of_pressure = x / radius_, .of_shear_x = height(x, y) / radius_};
}

LeverArm IndenterShape::torque(double x, double y) const {
  if (kinematics_ == Kinematics::consistent) return {.of_shear_x = -radius_ * slip(x, y).turning};
  if (!flat_in_y_) return {.of_pressure = x, .of_shear_x = -height(x, y)};
  return {.of_shear_x = -radius_};
}

RigidSlip IndenterShape::slip(double x, double y) const {
  if (kinematics_ == Kinematics::consistent) {
    const double slope_x = slope(x, y), q = height(x, y), turning = (q + x * x / q) / radius_;
    return {.forward = 1 + (1 - share_) * slope_x * slope_x, .turning = turning - share_ * (turning - 1)};
  }
  if (flat_in_y_) return {};
  return {.turning = std::sqrt(std::max(1 - y * y / (radius_ * radius_), 1e-4))};
}

RigidSlip IndenterShape::law_slip(double x, double y) const {
  const RigidSlip rigid = slip(x, y);
  const double apart = rigid.forward - rigid.turning, turning = rigid.turning + share_ * apart;
  return share_ == 0 ? rigid : RigidSlip{.forward = apart + turning, .turning = turning};
}

double IndenterShape::curvature(double x, double y) const {
  const double q = height(x, y);
  return (1 - bent_) * (radius_ * radius_ - y * y) / (q * q * q) + bent_ * std::cos(x / radius_) / radius_;
}

LeverArm IndenterShape::unbalanced_power(double omega, double x, double y) const {
  const LeverArm force = driving_force(x, y), turning = torque(x, y);
  const RigidSlip rigid = slip(x, y);
  return {.of_pressure = force.of_pressure + omega * turning.of_pressure / radius_ - slope(x, y),
          .of_shear_x = force.of_shear_x + omega * (turning.of_shear_x / radius_ + rigid.turning) - rigid.forward};
}

}  // namespace rollres
