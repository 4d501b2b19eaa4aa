#include "core/spectral/graded_slopes.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/chebyshev.hpp"
#include "core/numerics/memory_functions.hpp"
#include "core/spectral/graded_system.hpp"

namespace rollres {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Steps between a place and a node over which the rule is mended for logarithm and jump, how it fades, and from where
/// on there is nothing left of it.
constexpr double mended = 10, fading = 3;
constexpr Index mended_at_all = 26;

/// What the rule of even steps makes of ln|s| and of the jump at s = 0, against their integrals over the functions that
/// the nodes resolve, at a distance in steps: sources ahead of the place have a positive one.
struct Mend {
  double logarithm, jump;
};

Mend mend(double distance) {
  const double k = std::abs(distance), taper = 0.5 * std::erfc((k - mended) / fading);
  const TrigonometricIntegrals integrals = trigonometric_integrals(M_PI * k);
  const double rest = integrals.sine / M_PI - 0.5;
  return {-taper * integrals.cosine, taper * (distance > 0 ? rest : -rest)};
}

/// The same at odd halves.
const Mend& mend_at_half(Index steps) {  // distance steps + 1/2 >= 0, less than mended_at_all
  static const std::vector<Mend> table = [] {
    std::vector<Mend> values;
    for (Index k = 0; k < mended_at_all; ++k) values.push_back(mend(static_cast<double>(k) + 0.5));
    return values;
  }();
  return table[static_cast<std::size_t>(steps)];
}

}  // namespace

GradedSlopes::GradedSlopes(const SpectralProblem& problem, const GradedGrid& grid, const GradedPlaces& middles,
                           int order, bool sheared)
    : problem_(problem), nodes_(grid.size()) {
  measure_poles(grid, middles);
  if (problem.deep->remembers()) measure_retarded(grid, middles);
  if (problem.layered()) measure_layers(grid, middles, order, sheared);
}

void GradedSlopes::measure_poles(const GradedGrid& grid, const GradedPlaces& middles) {
  poles_ = MatrixXd::Zero(nodes_ + 1, nodes_);
  const GradedSources& sources = grid.sources();
  for (std::size_t k = 0; k < sources.size(); ++k)
    poles_.col(sources.nodes[k]).array() += sources.weights[k] / middles.less(sources.places[k]);
  for (Index i = 0; i <= nodes_; ++i) {
    stencils_.push_back(grid.at_middle(i));
    const GradedStencil& stencil = stencils_.back();
    if (grid.is_border(i))
      poles_.row(i).segment(stencil.first, stencil.weights.size()) += grid.left_out_at(i) * stencil.weights.transpose();
  }
}

void GradedSlopes::measure_retarded(const GradedGrid& grid, const GradedPlaces& middles) {
  const DeepResponse& deep = *problem_.deep;
  retarded_normal_ = retarded_along_ = retarded_cross_ = MatrixXd::Zero(nodes_ + 1, nodes_);
  for (Index j = 0; j < nodes_; ++j) {
    const Eigen::ArrayXd x = middles.less(grid.nodes()[static_cast<std::size_t>(j)]);
    Eigen::ArrayX3d k = grid.weight()(j) * deep.slopes(x);
    // In one zone the sum passes the logarithm and the jump.
    const GradedZone& zone = grid.zones()[grid.zone_of(j)];
    const double rate = zone.step * zone.rate(static_cast<double>(j - zone.first) * zone.step - zone.reach);
    const Index first = std::max(zone.first + 1, j + 1 - mended_at_all),
                end = std::min(zone.first + zone.count, j + 1 + mended_at_all);
    const Eigen::ArrayX3d growing = rate * deep.growing(Eigen::ArrayXd(x.segment(first, end - first)));
    for (Index i = first; i < end; ++i) {
      const Mend& m = mend_at_half(j >= i ? j - i : i - j - 1);
      k.row(i).head<2>() += m.logarithm / (2 * M_PI) * growing.row(i - first).head<2>();
      k(i, 2) -= (j >= i ? m.jump : -m.jump) * growing(i - first, 2);
    }
    retarded_normal_.col(j) = k.col(0);
    retarded_along_.col(j) = k.col(1);
    retarded_cross_.col(j) = k.col(2);
  }
}

/// Smooth corrections: between Chebyshev points of the contact where these are fewer.
void GradedSlopes::measure_layers(const GradedGrid& grid, const GradedPlaces& middles, int order, bool sheared) {
  const Interval contact{grid.zones().front().interval.from, grid.zones().back().interval.to};
  const double distance = 2 * problem_.correction->depth() / contact.half_length();
  const double rate = std::log(distance + std::sqrt(distance * distance + 1));
  // To a hundredth of what the graded points resolve.
  const auto few = static_cast<Index>(std::min(8 - std::log(0.01 * graded_tail(order)) / rate, 400.0));
  VectorXd nodes(nodes_);
  for (Index j = 0; j < nodes_; ++j) nodes(j) = grid.nodes()[static_cast<std::size_t>(j)].x();
  if (few >= nodes_) {
    from_nodes_ = grid.weight().asDiagonal();
    return tabulate(middles.x(), nodes, sheared);
  }
  const ChebyshevFit& fit = chebyshev_fit(static_cast<int>(few));
  const VectorXd points = contact.centre() + contact.half_length() * fit.nodes.array();
  const auto to = [&](const VectorXd& x) {
    MatrixXd images(x.size(), few);
    for (Index i = 0; i < x.size(); ++i)
      images.row(i) =
          chebyshev_images(std::clamp(place_in(contact, x(i)), -1.0, 1.0), static_cast<int>(few)).transpose();
    return MatrixXd(images * fit.from_values);
  };
  to_middles_ = to(middles.x());
  from_nodes_ = to(nodes).transpose() * grid.weight().asDiagonal();
  tabulate(points, points, sheared);
}

void GradedSlopes::tabulate(const VectorXd& x, const VectorXd& sources, bool sheared) {
  layer_normal_.resize(x.size(), sources.size());
  layer_along_ = layer_cross_ = MatrixXd::Zero(x.size(), sources.size());
  for (Index q = 0; q < sources.size(); ++q)
    for (Index i = 0; i < x.size(); ++i) {
      const LayerSlopes k = problem_.correction->slope(x(i) - sources(q));
      layer_normal_(i, q) = k(layer_slope::normal);
      if (!sheared) continue;
      layer_along_(i, q) = k(layer_slope::tangential);
      layer_cross_(i, q) = k(layer_slope::cross);
    }
}

VectorXd GradedSlopes::between_nodes(const VectorXd& values) const {
  VectorXd at(nodes_ + 1);
  for (Index i = 0; i <= nodes_; ++i) {
    const GradedStencil& stencil = stencils_[static_cast<std::size_t>(i)];
    at(i) = stencil.weights.dot(values.segment(stencil.first, stencil.weights.size()));
  }
  return at;
}

GradedSlopes::Slopes GradedSlopes::retarded(const VectorXd& pressure, const VectorXd& shear) const {
  if (retarded_normal_.size() == 0) return {VectorXd::Zero(nodes_ + 1), VectorXd::Zero(nodes_ + 1)};
  return {-retarded_normal_ * pressure - retarded_cross_ * shear, retarded_along_ * shear - retarded_cross_ * pressure};
}

GradedSlopes::Slopes GradedSlopes::of(const VectorXd& pressure, const VectorXd& shear) const {
  const DeepResponse& deep = *problem_.deep;
  Slopes slopes = retarded(pressure, shear);
  slopes.w += deep.normal() / (2 * M_PI) * (poles_ * pressure) + deep.cross() * between_nodes(shear);
  slopes.u += -deep.along() / (2 * M_PI) * (poles_ * shear) + deep.cross() * between_nodes(pressure);
  if (layer_normal_.size() == 0) return slopes;
  const VectorXd p = from_nodes_ * pressure, q = from_nodes_ * shear;
  const VectorXd w = layer_normal_ * p + layer_cross_ * q, u = layer_along_ * q - layer_cross_ * p;
  if (to_middles_.size() == 0) {
    slopes.w -= w;
    slopes.u += u;
  } else {
    slopes.w -= to_middles_ * w;
    slopes.u += to_middles_ * u;
  }
  return slopes;
}

MatrixXd GradedSlopes::spread(const MatrixXd& kernel, Index first, Index rows) const {
  if (to_middles_.size() == 0) return kernel.middleRows(first, rows) * from_nodes_.diagonal().asDiagonal();
  const MatrixXd forces = kernel * from_nodes_;
  return to_middles_.middleRows(first, rows) * forces;
}

MatrixXd GradedSlopes::normal(Index first, Index rows) const {
  MatrixXd slopes = problem_.deep->normal() / (2 * M_PI) * poles_.middleRows(first, rows);
  if (retarded_normal_.size() != 0) slopes -= retarded_normal_.middleRows(first, rows);
  if (layer_normal_.size() != 0) slopes -= spread(layer_normal_, first, rows);
  return slopes;
}

MatrixXd GradedSlopes::along(Index first, Index rows) const {
  MatrixXd slopes = -problem_.deep->along() / (2 * M_PI) * poles_.middleRows(first, rows);
  if (retarded_along_.size() != 0) slopes += retarded_along_.middleRows(first, rows);
  if (layer_along_.size() != 0) slopes += spread(layer_along_, first, rows);
  return slopes;
}

MatrixXd GradedSlopes::cross(Index first, Index rows) const {
  MatrixXd slopes = MatrixXd::Zero(rows, nodes_);
  for (Index i = 0; i < rows; ++i) {
    const GradedStencil& stencil = stencils_[static_cast<std::size_t>(first + i)];
    slopes.row(i).segment(stencil.first, stencil.weights.size()) = problem_.deep->cross() * stencil.weights.transpose();
  }
  if (retarded_cross_.size() != 0) slopes -= retarded_cross_.middleRows(first, rows);
  if (layer_cross_.size() != 0) slopes -= spread(layer_cross_, first, rows);
  return slopes;
}

}  // namespace rollres
