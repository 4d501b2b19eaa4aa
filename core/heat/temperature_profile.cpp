#include "core/heat/temperature_profile.hpp"

#include <algorithm>

#include "core/numerics/bracketed_root.hpp"
#include "core/numerics/quadrature.hpp"

namespace rollres {

namespace {

/// The polynomial through values at these nodes.
double through(const std::vector<double>& nodes, const std::vector<double>& values, double place) {
  double sum = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    double basis = values[i];
    for (std::size_t j = 0; j < nodes.size(); ++j)
      if (j != i) basis *= (place - nodes[j]) / (nodes[i] - nodes[j]);
    sum += basis;
  }
  return sum;
}

const QuadratureRule& rule_of(const LossPanel& panel) { return gauss_rule(static_cast<int>(panel.loss.size())); }

}  // namespace

TemperatureProfile::TemperatureProfile(const HeatPath& path, std::vector<LossPanel> panels, double at_face)
    : path_(path), panels_(std::move(panels)), lost_(1) {
  for (const LossPanel& panel : panels_) {
    const QuadratureRule& rule = rule_of(panel);
    Lost sum = lost_.back();
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double lost = (panel.to - panel.from) * rule.weights[i] * panel.loss[i];
      sum.loss += lost;
      sum.moment += lost * path_.resistance(panel.from + (panel.to - panel.from) * rule.nodes[i]);
    }
    lost_.push_back(sum);
  }
  ends_ = ends_of(lost_.back(), at_face);
}

/// With temperatures over that of the air, and P what the face gives and takes there:
/// F(0) = P - g T(0); T(0) = T_c + (r_H + 1/g_c) F(0) + (r_H + 1/g_c) L(H) - M(H).
TemperatureProfile::Ends TemperatureProfile::ends_of(const Lost& whole, double at_face) const {
  const double air = path_.air.temperature;
  const double conductance = path_.air.conductance + path_.ground.conductance;
  const double power = at_face + path_.ground.conductance * (path_.ground.temperature - air);
  if (path_.core.conductance == 0) return {(power + whole.loss) / conductance, -whole.loss};
  const double resistance = path_.resistance(path_.thickness) + 1 / path_.core.conductance;
  const double rise = (path_.core.temperature - air + resistance * (whole.loss + power) - whole.moment) /
                      (1 + resistance * conductance);
  return {rise, power - conductance * rise};
}

TemperatureProfile::Lost TemperatureProfile::lost_above(double depth) const {
  std::size_t i = 0;
  while (i < panels_.size() && panels_[i].to <= depth) ++i;
  Lost sum = lost_[i];
  if (i == panels_.size() || !(depth > panels_[i].from)) return sum;
  const LossPanel& panel = panels_[i];
  const QuadratureRule& rule = rule_of(panel);
  const double part = depth - panel.from, share = part / (panel.to - panel.from);
  for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
    const double lost = part * rule.weights[j] * through(rule.nodes, panel.loss, share * rule.nodes[j]);
    sum.loss += lost;
    sum.moment += lost * path_.resistance(panel.from + part * rule.nodes[j]);
  }
  return sum;
}

double TemperatureProfile::at(double depth) const {
  const Lost lost = lost_above(depth);
  return face() - path_.resistance(depth) * (ends_.inwards + lost.loss) + lost.moment;
}

double TemperatureProfile::mean_of(const Ends& ends, bool with_loss) const {
  const bool by_loss = lost_.back().loss > 0;
  double sum = 0, weights = 0;
  for (const LossPanel& panel : panels_) {
    const QuadratureRule& rule = rule_of(panel);
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double depth = panel.from + (panel.to - panel.from) * rule.nodes[i];
      const double weight = (panel.to - panel.from) * rule.weights[i] * (by_loss ? panel.loss[i] : 1);
      sum += weight * (with_loss ? at(depth) : without_loss(ends, depth));
      weights += weight;
    }
  }
  return sum / weights;
}

double TemperatureProfile::mean() const { return mean_of(ends_, true); }

double TemperatureProfile::mean_without_loss() const { return mean_of(ends_of({}, 0), false); }

std::vector<double> TemperatureProfile::scaled_to(double mean, const std::vector<double>& depths) const {
  const Ends idle = ends_of({}, 0);
  const double idle_mean = mean_of(idle, false), rise = this->mean() - idle_mean;
  const double factor = rise > 0 ? (mean - idle_mean) / rise : 0;
  std::vector<double> temperatures;
  for (const double depth : depths) {
    const double base = without_loss(idle, depth);
    temperatures.push_back(base + factor * (at(depth) - base));
  }
  return temperatures;
}

TemperatureProfile::Peak TemperatureProfile::peak() const {
  const auto inwards = [&](double depth) { return ends_.inwards + lost_above(depth).loss; };
  double depth = ends_.inwards >= 0 ? 0 : path_.thickness;
  if (path_.core.conductance > 0)
    if (const auto middle = root_between(inwards, 0.0, path_.thickness)) depth = *middle;
  return {depth, at(depth)};
}

}  // namespace rollres
