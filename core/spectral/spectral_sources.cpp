#include "core/spectral/spectral_sources.hpp"

#include <complex>

#include "core/numerics/chebyshev.hpp"
#include "core/numerics/quadrature.hpp"

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
  sources.runs.push_back({0, n, contact});
  sources.x.head(n) = contact.centre() + contact.half_length() * rule.nodes.array();
  sources.of_pressure.topLeftCorner(n, n) = contact.half_length() * rule.densities;
  if (pattern.shear && !own_nodes)
    sources.of_shear.topLeftCorner(n, n) = friction * pattern.direction(0) * sources.of_pressure.topLeftCorner(n, n);
  Index at = n;
  for (std::size_t z = 0; z < stick_places.size(); ++z, at += stick_n) {
    const Interval& stick = edges.sticks[z];
    sources.runs.push_back({at, stick_n, stick});
    sources.x.segment(at, stick_n) = stick.centre() + stick.half_length() * stick_rule.nodes.array();
    sources.of_shear.block(at, stick_places[z], stick_n, stick_n) = stick.half_length() * stick_rule.densities;
  }
  if (base_nodes > 0) {
    for (SourceRun run : base->runs()) {
      run.first += at;
      sources.runs.push_back(run);
    }
    sources.x.tail(base_nodes) = base->nodes();
    sources.of_shear.bottomLeftCorner(base_nodes, n) = friction * base->densities().leftCols(n);
  }
  return sources;
}

namespace {

/// Slopes under a unit force at each source: those of w or u, from forces of its own direction and from the other,
/// which of w have the hoop's part.
struct UnitSlopes {
  MatrixXd direct, cross;  // [point, source]

  UnitSlopes(const TractionSources& sources, const LayerKernel& layer, const VectorXd& x, Index direction)
      : direct(x.size(), sources.x.size()), cross(x.size(), sources.x.size()) {
    for (Index q = 0; q < sources.x.size(); ++q)
      for (Index i = 0; i < x.size(); ++i) {
        const LayerSlopes k = layer(x(i) - sources.x(q));
        direct(i, q) = k(direction);
        cross(i, q) = k(layer_slope::cross) + (direction == layer_slope::normal ? k(layer_slope::hoop) : 0);
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

namespace {

/// Of Gauss points between angles: ln|x - x(angle)| is singular at the angle of x and at its mirror images, off the
/// real axis where x is off the interval.
RowVectorXd missed_between_angles(const SourceRun& run, double x) {
  const auto count = static_cast<int>(run.count);
  const double t = place_in(run.interval, x), width = run.to_angle - run.from_angle;
  const std::complex<double> angle = std::abs(t) <= 1 ? std::complex<double>(std::acos(t))
                                                      : std::complex<double>(t > 0 ? 0 : M_PI, std::acosh(std::abs(t)));
  RowVectorXd missed = RowVectorXd::Zero(run.count);
  for (const std::complex<double> singular : {angle, -angle, 2 * M_PI - angle})
    missed += gauss_logarithm_missed(count, (singular - run.from_angle) / width);
  return missed;
}

}  // namespace

MissedSlopes missed_slopes(const RingLogarithms& logarithms, const std::vector<SourceRun>& runs,
                           const VectorXd& sources, double x) {
  MissedSlopes missed;
  missed.normal.resize(runs.front().count);
  if (!logarithms.hoop.none()) missed.hoop.resize(sources.size());
  for (const SourceRun& run : runs) {
    const bool pressed = &run == &runs.front();
    if (!pressed && logarithms.hoop.none()) break;
    const RowVectorXd of_logarithm = run.from_angle == run.to_angle
                                         ? logarithm_missed(static_cast<int>(run.count), place_in(run.interval, x))
                                         : missed_between_angles(run, x);
    for (Index k = 0; k < run.count; ++k) {
      const Index q = run.first + k;
      const double distance = x - sources(q);
      if (pressed) missed.normal(q) = distance == 0 ? 0 : of_logarithm(k) * logarithms.normal(distance);
      if (!logarithms.hoop.none()) missed.hoop(q) = distance == 0 ? 0 : of_logarithm(k) * logarithms.hoop(distance);
    }
  }
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
