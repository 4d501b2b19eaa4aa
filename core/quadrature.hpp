#pragma once

/// Small tools of numerical integration and approximation shared by the kernels.

#include <Eigen/Core>
#include <cmath>
#include <utility>
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

/// Several functions of a distance as Chebyshev series on panels; the panels may widen with the distance, as the
/// functions get smoother.
template <int Functions>
class ChebyshevTable {
 public:
  using Values = Eigen::Array<double, Functions, 1>;

  /// @param borders of the panels, ascending   @param sample values of the functions at a point
  template <class Sample>
  ChebyshevTable(std::vector<double> borders, int degree, const Sample& sample)
      : borders_(std::move(borders)), degree_(degree) {
    const int count = degree + 1, panels = static_cast<int>(borders_.size()) - 1;
    coefficients_.resize(static_cast<std::size_t>(panels * count), Values::Zero());
    for (int panel = 0; panel < panels; ++panel) {
      const auto p = static_cast<std::size_t>(panel);
      for (int node = 0; node < count; ++node) {
        const double angle = M_PI * (node + 0.5) / count;
        const Values value = sample(borders_[p] + 0.5 * (borders_[p + 1] - borders_[p]) * (1 + std::cos(angle)));
        for (int k = 0; k < count; ++k)
          coefficients_[static_cast<std::size_t>(panel * count + k)] +=
              value * ((k == 0 ? 1.0 : 2.0) / count * std::cos(k * angle));
      }
    }
  }

  /// @param x between the first and the last border
  Values operator()(double x) const {
    std::size_t panel = 0;
    while (panel + 2 < borders_.size() && x > borders_[panel + 1]) ++panel;
    const double t = 2 * (x - borders_[panel]) / (borders_[panel + 1] - borders_[panel]) - 1;
    const Values* c = &coefficients_[panel * static_cast<std::size_t>(degree_ + 1)];
    Values b1 = Values::Zero(), b2 = Values::Zero();
    for (int k = degree_; k > 0; --k) {  // Clenshaw
      const Values b0 = c[k] + 2 * t * b1 - b2;
      b2 = b1;
      b1 = b0;
    }
    return c[0] + t * b1 - b2;
  }

 private:
  std::vector<double> borders_;
  int degree_;
  std::vector<Values> coefficients_;
};

}  // namespace rollres
