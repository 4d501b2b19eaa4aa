#pragma once

/// Rules of numerical integration shared by the kernels; the last ones are for transforms of what a layer adds to its
/// half-space: smooth over wavenumbers from 0 to where it has vanished.

#include <Eigen/Core>

#include <cmath>
#include <complex>
#include <vector>

namespace rollres {

/// Nodes and weights on [-1, 1] or, after `on`, on an interval.
struct QuadratureRule {
  std::vector<double> nodes, weights;
};

/// Gauss-Legendre rule on [0, 1] with `order` nodes (Newton iteration on the Legendre polynomial).
QuadratureRule gauss_legendre(int order);

/// The same, kept for the thread.
const QuadratureRule& gauss_rule(int order);

/// What sums over the Gauss rule's nodes lack where a smooth function of s in [0, 1] times Re ln(place - s) is
/// integrated: by node, to be added to the logarithm there. @param place anywhere but at a node
Eigen::RowVectorXd gauss_logarithm_missed(int order, std::complex<double> place);

/// Integral over s in [0, inf) of e^{-s/T}/T K(s) for K known at nodes only: panels, each with Chebyshev-Lobatto
/// nodes, on which K is interpolated and multiplied exactly by the exponential. Both ends of a panel are nodes, so
/// that the sum tends to K(0) + T K'(0) as T -> 0, whatever the width of the panels.
class MemoryRule {
 public:
  /// Where K has a weak singularity (x log x), the nodes crowd at that end.
  enum class Singular { none, left, right };
  void add_panel(double start, double length, int order, Singular singular = Singular::none);

  const std::vector<double>& nodes() const { return nodes_; }  // distances s [m]
  /// Weights for memory length T [m]; e^{-s/T} of the panels' starts included.
  Eigen::VectorXd weights(double memory_length) const;

 private:
  struct Panel {
    double start, length;
    int order;
    Singular singular;
  };
  std::vector<Panel> panels_;
  std::vector<double> nodes_;
};

/// Distances over the length where panels of tables end, the last one beyond `end`: the functions are singular at
/// distances of +-2i and more only, so that panels may widen.
std::vector<double> distance_panels(double end);

/// At a distance r a function of k that is smooth relative to k matters up to k ~ 80/r only: beyond, it is faded out by
/// a smooth factor whose transform is there below e^{-(80/14)^2} = 1e-14. Bessel functions of an order begin to
/// oscillate at k ~ order/r.
struct WavenumberFade {
  double from, to;  // [1/m], or any other unit, as the distance

  explicit WavenumberFade(double r, int order = 0) : from(r > 0 ? (80 + 2 * order) / r : INFINITY), to(3 * from) {}
  double operator()(double k) const {
    return std::isinf(from) ? 1 : 0.5 * std::erfc(7 * (2 * (k - from) / (to - from) - 1));
  }
};

/// Nodes k with weights, fade included, for distances from r0 to r1; in any unit of length.
struct WavenumberRule {
  /// @param lowest wavenumber at which anything happens   @param highest that matters
  WavenumberRule(double lowest, double highest, double r0, double r1, int order = 0);

  std::vector<double> nodes, weights;
};

}  // namespace rollres
