#pragma once

/// Small tools of numerical integration and approximation shared by the kernels.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "core/numerics/solution_limits.hpp"

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
    double narrowest = borders_.back() - borders_.front();
    for (std::size_t i = 0; i + 1 < borders_.size(); ++i)
      narrowest = std::min(narrowest, borders_[i + 1] - borders_[i]);
    per_bin_ = 1 / narrowest;
    const auto bins = checked_count(std::ceil((borders_.back() - borders_.front()) * per_bin_), "panels of a table");
    for (int bin = 0, panel = 0; bin <= bins; ++bin) {
      const double start = borders_.front() + bin / per_bin_;
      while (panel + 2 < static_cast<int>(borders_.size()) && borders_[static_cast<std::size_t>(panel) + 1] <= start)
        ++panel;
      first_panel_.push_back(panel);
    }
  }

  /// @param x between the first and the last border
  Values operator()(double x) const { return at(std::array<double, 1>{x})[0]; }

  /// At several points at once, which a processor does side by side.
  template <std::size_t Points>
  std::array<Values, Points> at(const std::array<double, Points>& x) const {
    std::array<Values, Points> b1, b2;
    std::array<double, Points> t;
    std::array<const Values*, Points> c;
    for (std::size_t i = 0; i < Points; ++i) {
      const double bin = std::min((x[i] - borders_.front()) * per_bin_, static_cast<double>(first_panel_.size() - 1));
      auto panel = static_cast<std::size_t>(first_panel_[bin > 0 ? static_cast<std::size_t>(bin) : 0]);
      while (panel + 2 < borders_.size() && x[i] > borders_[panel + 1]) ++panel;
      t[i] = 2 * (x[i] - borders_[panel]) / (borders_[panel + 1] - borders_[panel]) - 1;
      c[i] = &coefficients_[panel * static_cast<std::size_t>(degree_ + 1)];
      b1[i] = b2[i] = Values::Zero();
    }
    for (int k = degree_; k > 0; --k)  // Clenshaw
      for (std::size_t i = 0; i < Points; ++i) {
        const Values b0 = c[i][k] + 2 * t[i] * b1[i] - b2[i];
        b2[i] = b1[i];
        b1[i] = b0;
      }
    for (std::size_t i = 0; i < Points; ++i) b1[i] = c[i][0] + t[i] * b1[i] - b2[i];
    return b1;
  }

 private:
  std::vector<double> borders_;
  int degree_;
  std::vector<Values> coefficients_;
  double per_bin_;                // bins as wide as the narrowest panel
  std::vector<int> first_panel_;  // that a bin touches
};

}  // namespace rollres
