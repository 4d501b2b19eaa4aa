#pragma once

/// Points for tractions of any exponents at the ends of zones (core/spectral/README.md, section 9).
///
/// On each zone x = from + length/(1 + e^{-s}), nodes in even steps of s: they crowd towards both ends in geometric
/// progression, and the rule of equal weights in s is exact to e^{-2 pi^2/step} for x^g with any g > -1. Slopes are
/// taken half-way between the nodes, where the same rule gives Cauchy's principal value.

#include <Eigen/Core>
#include <vector>

#include "core/spectral/spectral_system.hpp"

namespace rollres {

/// x = base + offset, base an end of a zone: differences near it keep their digits [m].
struct GradedPlace {
  double base = 0, offset = 0;
  double x() const { return base + offset; }
  double less(const GradedPlace& other) const { return (base - other.base) + (offset - other.offset); }
};

/// Many of them.
struct GradedPlaces {
  Eigen::ArrayXd base, offset;

  explicit GradedPlaces(const std::vector<GradedPlace>& places);
  Eigen::ArrayXd x() const { return base + offset; }
  Eigen::ArrayXd less(const GradedPlace& other) const { return (base - other.base) + (offset - other.offset); }
};

struct GradedZone {
  Interval interval;
  bool stick;
  int direction;       // of the shear where it slips, +1 or -1; 0 without friction
  double step, reach;  // nodes at s = -reach, -reach + step, ... reach
  Eigen::Index first, count;

  GradedPlace place(double s) const;
  double rate(double s) const;       // dx/ds [m]
  double parameter(double x) const;  // s, no farther than a step beyond the last nodes
  double from_first_node(double s) const { return (s + reach) / step; }
};

/// Coefficients of values at nodes that give the value at a place.
struct GradedStencil {
  static constexpr int most = 18;
  Eigen::Index first = 0;
  Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, most, 1> weights;
};

/// Forces per value of a node: the nodes' own first, then those that continue them to the ends of zones.
struct GradedSources {
  std::vector<GradedPlace> places;
  std::vector<double> weights;  // [m]
  std::vector<Eigen::Index> nodes;

  std::size_t size() const { return places.size(); }
};

class GradedGrid {
 public:
  GradedGrid(const SlipPattern& pattern, const SpectralEdges& edges, int order);

  const std::vector<GradedZone>& zones() const { return zones_; }
  Eigen::Index size() const { return weight_.size(); }
  const std::vector<GradedPlace>& nodes() const { return nodes_; }
  const GradedSources& sources() const { return sources_; }
  const Eigen::VectorXd& weight() const { return weight_; }  // of all sources of a node [m]
  std::size_t zone_of(Eigen::Index node) const { return zone_of_[static_cast<std::size_t>(node)]; }

  /// Half-way before each node, and after the last: size() + 1 places; between two zones the border.
  GradedPlaces middles() const { return GradedPlaces(middles_); }
  bool is_border(Eigen::Index middle) const;
  /// Values at a middle from those at the nodes.
  GradedStencil at_middle(Eigen::Index middle) const;
  /// Values at a place of a zone from those at its nodes, or from those at its middles (which begin at the zone's
  /// first).
  GradedStencil at(const GradedZone& zone, double x) const;
  GradedStencil at_from_middles(const GradedZone& zone, double x) const;
  /// What the sources of the two zones at a border leave out of a principal value there, per value at the border.
  double left_out_at(Eigen::Index middle) const;
  const GradedZone* zone_at(double x) const;

 private:
  std::vector<GradedZone> zones_;
  std::vector<GradedPlace> nodes_, middles_;
  GradedSources sources_;
  std::vector<std::size_t> zone_of_;
  Eigen::VectorXd weight_;
};

}  // namespace rollres
