#pragma once

/// Rules of numerical integration shared by the kernels.

#include <Eigen/Core>
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

}  // namespace rollres
