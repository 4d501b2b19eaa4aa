#include "core/model/crowned_body.hpp"

#include <algorithm>
#include <cmath>

namespace rollres {

CrownedBody::CrownedBody(double radius, double transverse_radius, Crown crown, const std::array<double, 3>& axle)
    : radius_(radius), transverse_(transverse_radius), crown_(crown), axle_(axle), lowest_(lowest_place()) {}

CrownedBody::Place CrownedBody::lowest_place() const {
  const auto& [e_x, e_y, e_z] = axle_;
  const double level = std::hypot(e_x, e_y);
  if (crown_ == Crown::circle) {  // below the centre of the arc
    const double beyond = transverse_ - radius_, aside = -beyond * e_z / level;
    return {aside * e_x, aside * e_y, transverse_ - beyond * level};
  }
  const double square = radius_ * (radius_ - transverse_), deepest = std::sqrt(radius_ * radius_ - square * e_z * e_z);
  return {square * e_z * e_x / deepest, square * e_z * e_y / deepest, deepest};
}

double CrownedBody::fallen_arc(double along) const {
  const double arc = std::sqrt(std::max(transverse_ * transverse_ - along * along, 0.0));
  return std::min(along * along, transverse_ * transverse_) / (transverse_ + arc);
}

double CrownedBody::squared_radius(double along) const {
  if (crown_ == Crown::ellipse) return radius_ * (radius_ - along * along / transverse_);
  return std::pow(std::max(radius_ - fallen_arc(along), 0.0), 2);
}

double CrownedBody::half_slope(double along) const {
  if (crown_ == Crown::ellipse) return -along * radius_ / transverse_;
  const double least = 1e-4 * transverse_ * transverse_;
  const double arc = std::sqrt(std::max(transverse_ * transverse_ - along * along, least));
  return -(radius_ - transverse_ + arc) * along / arc;
}

double CrownedBody::depth(double x, double y) const {
  const auto& [e_x, e_y, e_z] = axle_;
  const double level = e_x * x + e_y * y, square = x * x + y * y;
  if (e_z == 0) return std::sqrt(std::max(squared_radius(level) + level * level - square, held() * held()));
  // Newton's method from below the body.
  constexpr int most_steps = 40;
  constexpr double enough = 1e-15;
  double h = lowest_.depth;
  for (int step = 0; step < most_steps; ++step) {
    const double along = level - e_z * h;
    const double beyond = square + h * h - along * along - squared_radius(along);
    const double change = beyond / (2 * (h + e_z * (along + half_slope(along))));
    h -= change;
    if (!(h > held())) return held();
    if (std::abs(change) < enough * h) break;
  }
  return h;
}

double CrownedBody::profile(double x, double y) const {
  const double h = depth(x, y);
  if (axle_[2] != 0) return lowest_.depth - h;
  // Without the cancellation of R - h: (R^2 - h^2)/(R + h).
  const double along = axle_[0] * x + axle_[1] * y, across = axle_[1] * x - axle_[0] * y;
  const double lower = fallen_arc(along);
  const double fallen =
      crown_ == Crown::ellipse ? along * along * radius_ / transverse_ : lower * (2 * radius_ - lower);
  return (fallen + across * across) / (radius_ + h);
}

std::array<double, 2> CrownedBody::slopes(double x, double y) const {
  const auto& [e_x, e_y, e_z] = axle_;
  const double h = depth(x, y), along = e_x * x + e_y * y - e_z * h, s = along + half_slope(along);
  return {(x - s * e_x) / (h + s * e_z), (y - s * e_y) / (h + s * e_z)};
}

}  // namespace rollres
