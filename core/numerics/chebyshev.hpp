#pragma once

/// Chebyshev series, and Chebyshev polynomials for densities sqrt(1 - t^2) sum phi_n U_n(t), n = 0 ... order - 1, whose
/// Cauchy integral
///     int sqrt(1 - s^2) U_n(s)/(t - s) ds = pi T_{n+1}(t)        (|t| <= 1),
/// is collocated at the order + 1 zeros of T_{order+1}; smooth functions are integrated against the density at the
/// order zeros of U_order.

#include <Eigen/Core>
#include <cstddef>
#include <span>

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

/// c_0 + c_1 T_1(t) + ... by Clenshaw's recurrence; at least one coefficient, of any type of array of fixed size.
template <class Value>
Value chebyshev_sum(std::span<const Value> c, double t) {
  Value b1 = Value::Zero(), b2 = Value::Zero();
  for (std::size_t k = c.size() - 1; k > 0; --k) {
    const Value b0 = c[k] + 2 * t * b1 - b2;
    b2 = b1;
    b1 = b0;
  }
  return c[0] + t * b1 - b2;
}

}  // namespace rollres
