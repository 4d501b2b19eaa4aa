#include "core/model/indenter_shape.hpp"

namespace rollres {

LeverArm IndenterShape::load(double x, double y) const {
  if (kinematics_ == Kinematics::consistent || !flat_in_y_) return {.of_pressure = 1};
  return {.of_pressure = height(x, y) / radius_, .of_shear_x = -x / radius_};
}

std::array<double, 2> IndenterShape::along_surface(double x, double y, double of_x, double of_y) const {
  const double b_x = slope(x, y), b_y = slope_across(x, y), along = (1 - share_) * (b_x * of_x + b_y * of_y);
  return {of_x + b_x * along, of_y + b_y * along};
}

LeverArm IndenterShape::driving_force(double x, double y) const {
  if (kinematics_ == Kinematics::consistent) {
    const auto [along, across] = along_surface(x, y, 1, 0);
    return {slope(x, y), along, across};
  }
  if (!flat_in_y_) return {.of_shear_x = 1};
  return {.of_pressure = x / radius_, .of_shear_x = height(x, y) / radius_};
}

LeverArm IndenterShape::resisting_force(double x, double y) const {
  if (kinematics_ == Kinematics::printed) return driving_force(x, y);
  const RigidSlip rigid = slip(x, y);
  return {slope(x, y), rigid.forward, rigid.forward_y};
}

LeverArm IndenterShape::side_force(double x, double y) const {
  if (flat_in_y_) return {.of_shear_y = 1};
  const auto [along, across] = along_surface(x, y, 0, 1);
  return {slope_across(x, y), along, across};
}

LeverArm IndenterShape::spin_moment(double x, double y) const {
  const auto [along, across] = along_surface(x, y, -y, x);
  return {x * slope_across(x, y) - y * slope(x, y), along, across};
}

LeverArm IndenterShape::overturning(double x, double y) const {
  const double q = height(x, y);
  const auto [along, across] = along_surface(x, y, 0, q);
  return {q * slope_across(x, y) - y, along, across};
}

LeverArm IndenterShape::torque(double x, double y) const {
  if (kinematics_ == Kinematics::consistent) {
    const RigidSlip rigid = slip(x, y);
    return {.of_shear_x = -radius_ * rigid.turning, .of_shear_y = -radius_ * rigid.turning_y};
  }
  if (!flat_in_y_) return {.of_pressure = x, .of_shear_x = -height(x, y)};
  return {.of_shear_x = -radius_};
}

RigidSlip IndenterShape::slip(double x, double y) const {
  if (kinematics_ == Kinematics::printed) {
    if (flat_in_y_) return {};
    return {.turning = std::sqrt(std::max(1 - y * y / (radius_ * radius_), 1e-4))};
  }
  const double q = height(x, y);
  if (flat_in_y_) {
    const double slope_x = slope(x), turning = (q + x * x / q) / radius_;
    return {1 + (1 - share_) * slope_x * slope_x, turning - share_ * (turning - 1), sideways_, 0};
  }
  const auto [forward, forward_y] = along_surface(x, y, 1 - pivot_ * y, pivot_ * x);
  // On a rigid plane, the share 1 of the coating, all shear acts along it, at one height.
  const double flat = share_, round = (1 - share_) / radius_;
  const double b_x = slope(x, y), b_y = slope_across(x, y);
  const double of_x = axle_[1] * q + axle_[2] * y, of_y = -axle_[2] * x - axle_[0] * q, along = b_x * of_x + b_y * of_y;
  return {forward, flat + round * (of_x + b_x * along), forward_y, round * (of_y + b_y * along)};
}

RigidSlip IndenterShape::law_slip(double x, double y) const {
  const RigidSlip rigid = slip(x, y);
  if (share_ == 0) return rigid;
  const double apart = rigid.forward - rigid.turning, turning = rigid.turning + share_ * apart;
  const double apart_y = rigid.forward_y - rigid.turning_y, turning_y = rigid.turning_y + share_ * apart_y;
  return {apart + turning, turning, apart_y + turning_y, turning_y};
}

double IndenterShape::curvature(double x, double y) const {
  const double q = height(x, y);
  // rho^2/q^3, in the frame of the travel
  const double slope_x = slope(x, y);
  if (roller_) return (1 + slope_x * slope_x) / q;
  return (1 - bent_) * (radius_ * radius_ - y * y) / (q * q * q) + bent_ * std::cos(x / radius_) / radius_;
}

LeverArm IndenterShape::unbalanced_power(double omega, double x, double y) const {
  if (kinematics_ == Kinematics::consistent) return {};
  const LeverArm force = driving_force(x, y), turning = torque(x, y);
  const RigidSlip rigid = slip(x, y);
  return {.of_pressure = force.of_pressure + omega * turning.of_pressure / radius_ - slope(x, y),
          .of_shear_x = force.of_shear_x + omega * (turning.of_shear_x / radius_ + rigid.turning) - rigid.forward};
}

}  // namespace rollres
