#pragma once

/// Chebyshev polynomials for densities sqrt(1 - t^2) sum phi_n U_n(t), n = 0 ... order - 1, whose Cauchy integral
///     int sqrt(1 - s^2) U_n(s)/(t - s) ds = pi T_{n+1}(t)        (|t| <= 1),
/// is collocated at the order + 1 zeros of T_{order+1}; smooth functions are integrated against the density at the
/// order zeros of U_order.

#include <Eigen/Core>

namespace rollres {

struct ChebyshevRule {
  explicit ChebyshevRule(int order);

  int order;
  Eigen::VectorXd nodes;      // t_k, zeros of U_order
  Eigen::MatrixXd densities;  // [node, n]: int sqrt(1 - t^2) U_n h dt = sum over nodes of this times h(t_k)
  Eigen::VectorXd points;     // t_i, zeros of T_{order+1}
  Eigen::MatrixXd images;     // [point, n]: T_n(t_i), n = 0 ... order
};

/// The rule of an order, kept for the thread.
const ChebyshevRule& chebyshev_rule(int order);

/// T_n(t) for n = 0 ... count - 1, |t| <= 1; beyond 1 the continuation (t - sqrt(t^2 - 1))^n of the density's field.
Eigen::VectorXd chebyshev_images(double t, int count);

}  // namespace rollres
