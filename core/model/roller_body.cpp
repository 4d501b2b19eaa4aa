#include "core/model/roller_body.hpp"

#include <algorithm>
#include <cmath>

namespace rollres {

RollerBody::RollerBody(const RollerOutline& outline, const std::array<double, 3>& axle)
    : outline_(outline), axle_(axle) {
  const auto& [e_x, e_y, e_z] = axle_;
  const auto [along, depth] = outline_.lowest(e_z);
  const double aside = (along + depth * e_z) / (e_x * e_x + e_y * e_y);
  lowest_ = {aside * e_x, aside * e_y, depth};
}

double RollerBody::outside(double x, double y, double depth) const {
  const double along = axle_[0] * x + axle_[1] * y - axle_[2] * depth;
  return x * x + y * y + depth * depth - along * along - outline_.squared_radius(along);
}

double RollerBody::depth(double x, double y) const {
  const auto& [e_x, e_y, e_z] = axle_;
  const double level = e_x * x + e_y * y, square = x * x + y * y;
  if (e_z == 0) {
    const double depth_squared = outline_.squared_radius(level) + level * level - square;
    return outline_.reaches(level) ? std::sqrt(std::max(depth_squared, held() * held())) : held();
  }
  const double found = searched_depth(x, y);
  return found > held() && outline_.reaches(level - e_z * found) ? found : held();
}

double RollerBody::searched_depth(double x, double y) const {
  const auto& [e_x, e_y, e_z] = axle_;
  // Newton's method from below the body.
  constexpr int most_steps = 40;
  constexpr double enough = 1e-15, rounding = 1e-13;
  double h = lowest_.depth;
  for (int step = 0; step < most_steps; ++step) {
    const double along = e_x * x + e_y * y - e_z * h;
    const double change = outside(x, y, h) / (2 * (h + e_z * (along + outline_.half_slope(along))));
    h -= change;
    if (!(h > held())) return held();
    if (std::abs(change) < enough * h) return h;
  }
  if (std::abs(outside(x, y, h)) < rounding * h * h) return h;
  // A profile with hollows may lead it astray: the first change of sign from below, halved.
  constexpr int parts = 200, halvings = 60;
  double below = lowest_.depth * (1 + enough);
  const double step = (below - held()) / parts;
  while (below > held() && outside(x, y, below - step) > 0) below -= step;
  if (!(below > held())) return held();
  double above = below - step;
  for (int halving = 0; halving < halvings; ++halving) {
    const double middle = 0.5 * (above + below);
    (outside(x, y, middle) > 0 ? below : above) = middle;
  }
  return below;
}

double RollerBody::profile(double x, double y) const {
  const double h = depth(x, y);
  if (axle_[2] != 0 || h == held()) return lowest_.depth - h;
  // Without the cancellation of R - h: (R^2 - h^2)/(R + h).
  const double along = axle_[0] * x + axle_[1] * y, across = axle_[1] * x - axle_[0] * y;
  return (outline_.fallen_square(along) + across * across) / (outline_.radius() + h);
}

std::array<double, 2> RollerBody::slopes(double x, double y) const {
  const auto& [e_x, e_y, e_z] = axle_;
  const double h = depth(x, y), along = e_x * x + e_y * y - e_z * h, s = along + outline_.half_slope(along);
  return {(x - s * e_x) / (h + s * e_z), (y - s * e_y) / (h + s * e_z)};
}

}  // namespace rollres
