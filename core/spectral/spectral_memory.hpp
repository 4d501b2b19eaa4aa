#pragma once

/// What the memories of a scene's layer make of densities on an interval (spectral_system.hpp).

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "core/spectral/spectral_system.hpp"

namespace rollres {

/// The exponentials e^{(x - to)/rho_j} of an interval that ends at `to`, split at a density's order, and the memories
/// R_{T_m} beyond its leading end (core/spectral/README.md, (S10), (S12), (S13)).
struct IntervalMemory {
  Eigen::MatrixXd series;      // [n, j]: Chebyshev coefficients, n = 0 ... order; beyond it they are left to tails
  Eigen::MatrixXd beyond;      // [k, j]: and those of n = order + 1 + k, as many as matter at a distance; perhaps none
  Eigen::MatrixXd memory;      // [n, m]: b_n (memory_functions.hpp), n = 0 ... order
  Eigen::MatrixXd tails;       // [j, m]: R_{T_m} at `to` of the field of the tail
  Eigen::VectorXd tail_lift;   // [j]: displacement at `to` by the tail, over the half-length
  std::vector<bool> has_tail;  // [j]

  IntervalMemory(const SpectralProblem& problem, const Interval& interval, int order);

  /// Field of the tail j per amplitude, at x outside the interval [1].
  double tail_field(std::size_t j, const Interval& interval, double x) const;
  bool any_tail() const;
  /// So many of `beyond` are more than rounding.
  int tail_terms() const;
};

/// What a slope f of the surface, prescribed on an interval, asks of the elastic slope there (S7).
struct PrescribedSlope {
  Eigen::VectorXd elastic;    // G_inf f - sum_j g_j r_j at the points, r_j - rho_j r_j' = f [Pa]
  Eigen::VectorXd amplitude;  // [j]: g_j r_j at the leading end, the right side of (S8) [Pa]

  PrescribedSlope(const SpectralProblem& problem, const Interval& interval, const Eigen::VectorXd& points,
                  const std::function<double(double)>& f);
};

/// Points for int_0^inf f(from + s) e^{-s/T}/T ds with all the scene's T, f having roots of the distance from the ends
/// of intervals only.
struct PointsAhead {
  Eigen::ArrayXd x;
  Eigen::ArrayXXd weights;  // [point, m]

  PointsAhead(const SpectralProblem& problem, const SpectralEdges& edges, double from, int order);
};

}  // namespace rollres
