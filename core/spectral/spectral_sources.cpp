#include "core/spectral/spectral_sources.hpp"

#include "core/numerics/chebyshev.hpp"

namespace rollres {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

TractionSources traction_sources(const SlipPattern& pattern, const SpectralEdges& edges, const SpectralOrders& orders,
                                 const SlidingBase* base, double friction, const std::vector<Index>& stick_places,
                                 Index unknowns) {
  const ChebyshevRule &rule = chebyshev_rule(orders.contact), &stick_rule = chebyshev_rule(orders.stick);
  const Interval& contact = edges.contact;
  const Index n = orders.contact, stick_n = orders.stick;
  const bool own_nodes = pattern.shear && !pattern.one_direction();  // of the base
  const Index base_nodes = own_nodes ? base->nodes().size() : 0;
  TractionSources sources;
  sources.pressure_nodes = n;
  sources.x.resize(n + static_cast<Index>(stick_places.size()) * stick_n + base_nodes);
  sources.of_pressure = MatrixXd::Zero(sources.x.size(), unknowns);
  sources.of_shear = MatrixXd::Zero(sources.x.size(), unknowns);
  sources.x.head(n) = contact.centre() + contact.half_length() * rule.nodes.array();
  sources.of_pressure.topLeftCorner(n, n) = contact.half_length() * rule.densities;
  if (pattern.shear && !own_nodes)
    sources.of_shear.topLeftCorner(n, n) = friction * pattern.direction(0) * sources.of_pressure.topLeftCorner(n, n);
  Index at = n;
  for (std::size_t z = 0; z < stick_places.size(); ++z, at += stick_n) {
    const Interval& stick = edges.sticks[z];
    sources.x.segment(at, stick_n) = stick.centre() + stick.half_length() * stick_rule.nodes.array();
    sources.of_shear.block(at, stick_places[z], stick_n, stick_n) = stick.half_length() * stick_rule.densities;
  }
  if (base_nodes > 0) {
    sources.x.tail(base_nodes) = base->nodes();
    sources.of_shear.bottomLeftCorner(base_nodes, n) = friction * base->densities().leftCols(n);
  }
  return sources;
}

namespace {

/// Slopes under a unit force at each source: those of w or u, from forces of its own direction and from the other.
struct UnitSlopes {
  MatrixXd direct, cross;  // [point, source]

  UnitSlopes(const TractionSources& sources, const LayerKernel& layer, const VectorXd& x, Index direction)
      : direct(x.size(), sources.x.size()), cross(x.size(), sources.x.size()) {
    for (Index q = 0; q < sources.x.size(); ++q)
      for (Index i = 0; i < x.size(); ++i) {
        const LayerSlopes k = layer(x(i) - sources.x(q));
        direct(i, q) = k(direction);
        cross(i, q) = k(layer_slope::cross);
      }
  }
};

}  // namespace

MatrixXd normal_slopes(const TractionSources& sources, const LayerKernel& layer, const VectorXd& x) {
  const Index n = sources.pressure_nodes;
  const UnitSlopes unit(sources, layer, x, layer_slope::normal);
  MatrixXd slopes = -unit.cross * sources.of_shear;
  slopes.leftCols(n) -= unit.direct.leftCols(n) * sources.of_pressure.topLeftCorner(n, n);
  return slopes;
}

MatrixXd tangential_slopes(const TractionSources& sources, const LayerKernel& layer, const VectorXd& x) {
  const Index n = sources.pressure_nodes;
  const UnitSlopes unit(sources, layer, x, layer_slope::tangential);
  MatrixXd slopes = unit.direct * sources.of_shear;
  slopes.leftCols(n) -= unit.cross.leftCols(n) * sources.of_pressure.topLeftCorner(n, n);
  return slopes;
}

RowVectorXd missed_slopes(const SlopeCorrection& correction, const Interval& contact, int order, double x) {
  const double half = contact.half_length();
  if (correction.logarithmic_slope(half, 2 * half) == 0) return {};
  const double t = place_in(contact, x);
  RowVectorXd missed = logarithm_missed(order, t);
  const VectorXd& nodes = chebyshev_rule(order).nodes;
  for (Index q = 0; q < nodes.size(); ++q)
    missed(q) = t == nodes(q) ? 0 : missed(q) * correction.logarithmic_slope(half * (t - nodes(q)), 2 * half);
  return missed;
}

RowVectorXd resultant_row(const IndenterShape& shape, LeverArm (IndenterShape::*arm)(double, double) const,
                          const TractionSources& sources) {
  RowVectorXd of_pressure(sources.x.size()), of_shear(sources.x.size());
  for (Index q = 0; q < sources.x.size(); ++q) {
    const LeverArm at = (shape.*arm)(sources.x(q), 0);
    of_pressure(q) = at.of_pressure;
    of_shear(q) = at.of_shear_x;
  }
  return of_pressure * sources.of_pressure + of_shear * sources.of_shear;
}

}  // namespace rollres
