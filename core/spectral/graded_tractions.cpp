#include "core/spectral/graded_tractions.hpp"

#include <algorithm>
#include <cmath>

namespace rollres {

GradedTractions::GradedTractions(const GradedGrid& of_grid, const Eigen::VectorXd& of_pressure,
                                 const Eigen::VectorXd& of_shear, const Eigen::VectorXd& by_w,
                                 const Eigen::VectorXd& by_u)
    : grid(of_grid), pressure(of_pressure), shear(of_shear), retarded_w(by_w), retarded_u(by_u) {
  const GradedSources& sources = grid.sources();
  source_x = GradedPlaces(sources.places).x();
  source_pressure.resize(source_x.size());
  source_shear.resize(source_x.size());
  for (std::size_t k = 0; k < sources.size(); ++k) {
    source_pressure(static_cast<Eigen::Index>(k)) = sources.weights[k] * pressure(sources.nodes[k]);
    source_shear(static_cast<Eigen::Index>(k)) = sources.weights[k] * shear(sources.nodes[k]);
  }
}

double GradedTractions::value_at(const Eigen::VectorXd& values, double x) const {
  const GradedZone* zone = grid.zone_at(x);
  if (!zone) return 0;
  const GradedStencil stencil = grid.at(*zone, x);
  return stencil.weights.dot(values.segment(stencil.first, stencil.weights.size()));
}

double GradedTractions::half_length() const {
  return 0.5 * (grid.zones().back().interval.to - grid.zones().front().interval.from);
}

double GradedTractions::nearest_judged() const {
  double nearest = INFINITY;
  for (const GradedZone& zone : grid.zones())
    nearest = std::min(nearest, std::abs(zone.place(zone.reach - judged_from).offset));
  return std::max(nearest, too_near * half_length());
}

bool GradedTractions::near_end(double x, double nearest) const {
  const GradedZone* zone = grid.zone_at(x);
  if (!zone) return false;
  if (std::min(x - zone->interval.from, zone->interval.to - x) < too_near * half_length()) return true;
  return std::abs(zone->parameter(x)) > zone->reach - nearest;
}

Eigen::Array2d GradedTractions::near_slopes(const SpectralProblem& problem, double x) const {
  const GradedZone* zone = grid.zone_at(x);
  if (!zone) return slopes_between_nodes(problem, nullptr, x);
  const double s = zone->parameter(x), most = zone->reach - 0.5 * zone->step;
  if (std::abs(s) > most) return slopes_between_nodes(problem, zone, zone->place(std::copysign(most, s)).x());
  const double steps = zone->from_first_node(s);
  if (constexpr double near = 1e-4; std::abs(steps - std::round(steps)) < near)  // at a node, from both sides
    return 0.5 * (slopes_between_nodes(problem, zone, zone->place(s - 2 * near * zone->step).x()) +
                  slopes_between_nodes(problem, zone, zone->place(s + 2 * near * zone->step).x()));
  return slopes_between_nodes(problem, zone, x);
}

Eigen::Array2d GradedTractions::slopes_between_nodes(const SpectralProblem& problem, const GradedZone* zone,
                                                     double x) const {
  const DeepResponse& deep = *problem.deep;
  Eigen::Array2d slopes = Eigen::Array2d::Zero();
  const Eigen::ArrayXd poles = (x - source_x).inverse() / (2 * M_PI);
  slopes << deep.normal() * (poles * source_pressure).sum(), -deep.along() * (poles * source_shear).sum();
  if (!zone) {
    if (deep.remembers()) {
      const Eigen::Index n = grid.size();  // the nodes' own are the first
      const Eigen::ArrayX3d k = deep.slopes(x - source_x.head(n)).colwise() * grid.weight().array();
      const auto p = pressure.array(), q = shear.array();
      slopes +=
          Eigen::Array2d(-(k.col(0) * p).sum() - (k.col(2) * q).sum(), (k.col(1) * q).sum() - (k.col(2) * p).sum());
    }
    return slopes;
  }
  // Between nodes the rule misses a principal value by a cotangent (S32).
  const double steps = zone->from_first_node(zone->parameter(x));
  const double missed = 0.5 / std::tan(M_PI * steps), p = pressure_at(x), q = shear_at(x);
  slopes += missed * Eigen::Array2d(-deep.normal() * p, deep.along() * q) + deep.cross() * Eigen::Array2d(q, p);
  if (deep.remembers()) {
    const GradedStencil stencil = grid.at_from_middles(*zone, x);
    slopes += Eigen::Array2d(stencil.weights.dot(retarded_w.segment(stencil.first, stencil.weights.size())),
                             stencil.weights.dot(retarded_u.segment(stencil.first, stencil.weights.size())));
  }
  return slopes;
}

}  // namespace rollres
