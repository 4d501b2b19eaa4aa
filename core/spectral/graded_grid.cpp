#include "core/spectral/graded_grid.hpp"

#include <algorithm>
#include <cmath>

namespace rollres {

namespace {

using Eigen::Index;

constexpr int continued = 14;                            // sources beyond the last node of a zone
constexpr Index interpolated = GradedStencil::most / 2;  // nodes on either side
/// Of the reach of nodes in the whole contact, at the ends of short zones.
constexpr double beside_short = 0.7;

/// The barycentric weights of so many even steps less one.
const Eigen::ArrayXd& even_steps(Index steps) {
  static const std::vector<Eigen::ArrayXd> table = [] {
    std::vector<Eigen::ArrayXd> weights;
    for (Index n = 0; n < GradedStencil::most; ++n) {
      weights.push_back(Eigen::ArrayXd::Ones(n + 1));
      for (Index j = 1; j <= n; ++j)
        weights.back()(j) = -weights.back()(j - 1) * static_cast<double>(n - j + 1) / static_cast<double>(j);
    }
    return weights;
  }();
  return table[static_cast<std::size_t>(steps)];
}

/// Lagrange's weights for the values at first, first + 1, ... at a place between them.
GradedStencil lagrange(double at, Index least, Index most) {
  // Near the end of a zone fewer nodes, not more on one side: their weights would grow.
  const auto before = static_cast<Index>(std::floor(at));
  const Index begin = std::max(least, before - interpolated + 1), end = std::min(most, before + interpolated);
  const Index count = end - begin + 1;
  GradedStencil stencil;
  stencil.first = begin;
  if (const double nearest = std::round(at); at == nearest && begin <= nearest && nearest <= end) {
    stencil.weights.setZero(count);
    stencil.weights(static_cast<Index>(nearest) - begin) = 1;
    return stencil;
  }
  const double from = at - static_cast<double>(begin);
  using Steps = Eigen::Array<double, Eigen::Dynamic, 1, Eigen::ColMajor, GradedStencil::most, 1>;
  stencil.weights = even_steps(count - 1) / (from - Steps::LinSpaced(count, 0, static_cast<double>(count - 1)));
  stencil.weights /= stencil.weights.sum();
  return stencil;
}

}  // namespace

GradedPlaces::GradedPlaces(const std::vector<GradedPlace>& places)
    : base(static_cast<Index>(places.size())), offset(static_cast<Index>(places.size())) {
  for (Index i = 0; i < base.size(); ++i) {
    base(i) = places[static_cast<std::size_t>(i)].base;
    offset(i) = places[static_cast<std::size_t>(i)].offset;
  }
}

GradedPlace GradedZone::place(double s) const {
  const double small = std::exp(-std::abs(s)), distance = (interval.to - interval.from) * small / (1 + small);
  return s < 0 ? GradedPlace{interval.from, distance} : GradedPlace{interval.to, -distance};
}

double GradedZone::rate(double s) const {
  const double small = std::exp(-std::abs(s));
  return (interval.to - interval.from) * small / ((1 + small) * (1 + small));
}

double GradedZone::parameter(double x) const {
  const double behind = x - interval.from, ahead = interval.to - x, most = reach + step;
  if (!(behind > 0)) return -most;
  if (!(ahead > 0)) return most;
  return std::clamp(std::log(behind / ahead), -most, most);
}

GradedGrid::GradedGrid(const SlipPattern& pattern, const SpectralEdges& edges, int order) {
  const Interval& contact = edges.contact;
  const auto add = [&](double from, double to, bool stick, int direction) {
    if (to > from) zones_.push_back({{from, to}, stick, direction, 0, 0, 0, 0});
  };
  double at = contact.from;
  for (std::size_t i = 0; i < pattern.sticks(); ++i) {
    if (pattern.slips[i] != 0) add(at, edges.sticks[i].from, false, pattern.slips[i]);
    add(edges.sticks[i].from, edges.sticks[i].to, true, 0);
    at = edges.sticks[i].to;
  }
  if (pattern.slips.empty() || pattern.slips.back() != 0)
    add(at, contact.to, false, pattern.slips.empty() ? 0 : pattern.slips.back());

  const auto add_source = [&](const GradedPlace& place, double weight, Index node) {
    sources_.places.push_back(place);
    sources_.weights.push_back(weight);
    sources_.nodes.push_back(node);
  };
  // The rule's error e^{-2 pi^2/step} and what the last nodes leave out, length^1.5, as one.
  const double step = std::sqrt(4 * M_PI * M_PI / 1.5 / std::max(order, 4));
  const double reach = 2 * M_PI * M_PI / 1.5 / step;
  double scale = 2 * contact.half_length();
  const auto length_of = [&](std::size_t z) { return zones_[z].interval.to - zones_[z].interval.from; };
  for (std::size_t z = 0; z < zones_.size(); ++z) {
    GradedZone& zone = zones_[z];
    const double length = length_of(z);
    double wanted = std::max(reach + std::log(length / scale), beside_short * reach);
    if (z > 0) wanted = std::max(wanted, beside_short * reach + std::log(length / length_of(z - 1)));
    if (z + 1 < zones_.size()) wanted = std::max(wanted, beside_short * reach + std::log(length / length_of(z + 1)));
    zone.count = 2 * static_cast<Index>(std::ceil(wanted / step - 0.5)) + 2;
    zone.reach = wanted;
    zone.step = 2 * wanted / static_cast<double>(zone.count - 1);
    zone.first = static_cast<Index>(nodes_.size());
    middles_.push_back(z == 0 ? zone.place(-zone.reach - 0.5 * zone.step) : GradedPlace{zone.interval.from, 0});
    for (Index j = 0; j < zone.count; ++j) {
      const double s = -zone.reach + static_cast<double>(j) * zone.step;
      nodes_.push_back(zone.place(s));
      zone_of_.push_back(z);
      add_source(zone.place(s), zone.step * zone.rate(s), zone.first + j);
      if (j + 1 < zone.count) middles_.push_back(zone.place(s + 0.5 * zone.step));
    }
    if (z + 1 == zones_.size()) middles_.push_back(zone.place(zone.reach + 0.5 * zone.step));
  }
  for (std::size_t z = 0; z < zones_.size(); ++z) {
    const GradedZone& zone = zones_[z];
    for (const int side : {-1, 1}) {
      const bool edge = side < 0 ? z == 0 : z + 1 == zones_.size();
      for (int k = 1; k <= continued; ++k) {
        const double s = side * (zone.reach + k * zone.step);
        const double falls = edge ? std::exp(-0.5 * k * zone.step) : 1;  // like the root of the distance
        add_source(zone.place(s), falls * zone.step * zone.rate(s),
                   side < 0 ? zone.first : zone.first + zone.count - 1);
      }
    }
  }
  weight_ = Eigen::VectorXd::Zero(static_cast<Index>(nodes_.size()));
  for (std::size_t k = 0; k < sources_.size(); ++k) weight_(sources_.nodes[k]) += sources_.weights[k];
}

bool GradedGrid::is_border(Index middle) const {
  return middle > 0 && middle < size() && zone_of(middle - 1) != zone_of(middle);
}

GradedStencil GradedGrid::at_middle(Index middle) const {
  if (is_border(middle)) return {middle - 1, Eigen::VectorXd::Constant(2, 0.5)};
  if (middle == 0 || middle == size()) {
    const GradedZone& zone = middle == 0 ? zones_.front() : zones_.back();
    return {middle == 0 ? 0 : middle - 1, Eigen::VectorXd::Constant(1, std::exp(-0.25 * zone.step))};
  }
  const GradedZone& zone = zones_[zone_of(middle)];
  GradedStencil stencil = lagrange(static_cast<double>(middle - zone.first) - 0.5, 0, zone.count - 1);
  stencil.first += zone.first;
  return stencil;
}

GradedStencil GradedGrid::at(const GradedZone& zone, double x) const {
  const double at = zone.from_first_node(zone.parameter(x)), last = static_cast<double>(zone.count - 1);
  if (at < 0 || at > last) {
    const bool edge = at < 0 ? zone.first == 0 : zone.first + zone.count == size();
    const double distance = at < 0 ? x - zone.interval.from : zone.interval.to - x;
    const double at_node = std::abs(zone.place(zone.reach).offset);
    const double falls = edge ? std::sqrt(std::max(distance, 0.0) / at_node) : 1;
    return {at < 0 ? zone.first : zone.first + zone.count - 1, Eigen::VectorXd::Constant(1, falls)};
  }
  GradedStencil stencil = lagrange(at, 0, zone.count - 1);
  stencil.first += zone.first;
  return stencil;
}

GradedStencil GradedGrid::at_from_middles(const GradedZone& zone, double x) const {
  const double at =
      std::clamp(zone.from_first_node(zone.parameter(x)) + 0.5, 0.5, static_cast<double>(zone.count) - 0.5);
  // The border's own value does not stand half a step from its neighbours.
  GradedStencil stencil = lagrange(at, 1, zone.count - 1);
  stencil.first += zone.first;
  return stencil;
}

double GradedGrid::left_out_at(Index middle) const {
  if (!is_border(middle)) return 0;
  const auto nearest = [&](const GradedZone& zone) {
    return std::log(std::abs(zone.place(zone.reach + (continued + 0.5) * zone.step).offset));
  };
  return nearest(zones_[zone_of(middle - 1)]) - nearest(zones_[zone_of(middle)]);
}

const GradedZone* GradedGrid::zone_at(double x) const {
  for (const GradedZone& zone : zones_)
    if (x >= zone.interval.from && x <= zone.interval.to) return &zone;
  return nullptr;
}

}  // namespace rollres
