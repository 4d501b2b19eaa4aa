/// Of FiniteContact: where the nodes of the surface are, in which zones, and what they add up to.

#include <algorithm>
#include <cmath>

#include "core/finite_strain/finite_newton.hpp"

namespace rollres {

void FiniteContact::place_nodes(const FiniteState& state) {
  rotation_ratio_ = state.rotation_ratio;
  approach_ = state.approach;
  const Eigen::Vector2d axis(0, model_.radius - approach_);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    SurfaceNode& node = nodes_[i];
    node.position = layer_.mesh().rest(node.place, 0) + state.unknowns.segment<2>(displacement(i));
    if (covered()) {
      node.outward = Eigen::Vector2d(0, -1);
      node.distance = INFINITY;
      node.arc = node.position.x();
      node.gap = -approach_ - node.position.y();
    } else {
      const Eigen::Vector2d arm = node.position - axis;
      node.distance = arm.norm();
      node.outward = arm / node.distance;
      node.arc = model_.radius * std::atan2(arm.x(), -arm.y());
      node.per_step = model_.radius / node.distance;
      // |x - c| - R without the difference of what is nearly alike: bodies may be 10^4 contacts wide.
      const double height = node.position.y() + approach_;
      node.gap = (node.position.x() * node.position.x() + height * (height - 2 * model_.radius)) /
                 (node.distance + model_.radius);
    }
    node.tangent = Eigen::Vector2d(-node.outward.y(), node.outward.x());
    node.normal = state.unknowns(normal(i));
    if (!sheared()) continue;
    node.shear = state.unknowns(shear(i));
    if (i == 0) continue;
    node.stretch = (node.arc - nodes_[i - 1].arc) / (node.place - nodes_[i - 1].place);
    node.slip = slip_at(node.stretch);
  }
}

bool FiniteContact::choose_zones() {
  constexpr double slip_weight = 1;  // c of (C2) over the unit of stress and the length that a node stands for
  bool changed = false;
  for (std::size_t i = 1; i < nodes_.size(); ++i) {
    SurfaceNode& node = nodes_[i];
    Zone zone = Zone::free;
    if (node.normal - node.gap > 0 && node.outward.y() < 0) {
      zone = Zone::slip;
      if (with_friction_) {
        const FrictionProjection shear =
            law_.project(std::max(node.normal, 0.0), node.shear + slip_weight * node.share * node.slip);
        if (!shear.slips())
          zone = Zone::stick;
        else {
          changed = changed || shear.direction_x() != node.direction;
          node.direction = shear.direction_x();
        }
      }
    }
    changed = changed || zone != node.zone;
    node.zone = zone;
  }
  return changed;
}

double FiniteContact::load() const {
  double sum = 0;
  for (const SurfaceNode& node : nodes_) sum -= node.normal * node.outward.y() + node.shear * node.tangent.y();
  return sum;
}

double FiniteContact::driving_force() const {
  double sum = 0;
  for (const SurfaceNode& node : nodes_) sum += node.normal * node.outward.x() + node.shear * node.tangent.x();
  return covered() ? -sum : sum;
}

double FiniteContact::torque() const {
  double sum = 0;
  for (const SurfaceNode& node : nodes_)
    sum += covered() ? node.normal * node.position.x() + node.shear * lever(node) : -node.shear * model_.radius;
  return sum;
}

double FiniteContact::slip(std::size_t node) const {
  if (node == 0 || node + 1 >= nodes_.size()) return 0;
  const SurfaceNode &before = nodes_[node - 1], &at = nodes_[node], &after = nodes_[node + 1];
  const double a = at.place - before.place, b = after.place - at.place;
  const double into = (at.arc - before.arc) / a, out = (after.arc - at.arc) / b;
  return slip_at((into * b + out * a) / (a + b));
}

double FiniteContact::friction_power() const {
  double sum = 0;
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    if (with_friction_ && nodes_[i].zone == Zone::slip) sum += nodes_[i].shear * slip(i);
  return sum;
}

double FiniteContact::friction_power_missed() const {
  double missed = 0;
  for (std::size_t first = 1; with_friction_ && first + 1 < nodes_.size(); ++first) {
    if (nodes_[first].zone != Zone::slip) continue;
    std::size_t beyond = first;
    double power = 0, steps = 0;
    for (; beyond + 1 < nodes_.size() && nodes_[beyond].zone == Zone::slip; ++beyond)
      power += nodes_[beyond].shear * slip(beyond);
    if (nodes_[first - 1].zone == Zone::stick) steps += nodes_[first - 1].place - nodes_[first].place;
    if (nodes_[beyond].zone == Zone::stick) steps += nodes_[beyond - 1].place - nodes_[beyond].place;
    const double share = std::min(1.0, steps / (nodes_[first - 1].place - nodes_[beyond].place));
    missed += share * share * std::abs(power);
    first = beyond;
  }
  return missed;
}

}  // namespace rollres
