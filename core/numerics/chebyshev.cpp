#include "core/numerics/chebyshev.hpp"

#include "core/numerics/recently_made.hpp"

namespace rollres {

ChebyshevRule::ChebyshevRule(int given_order)
    : order(given_order), nodes(order), densities(order, order), points(order + 1), images(order + 1, order + 1) {
  for (int k = 0; k < order; ++k) {
    const double angle = M_PI * (k + 1) / (order + 1), sine = std::sin(angle);
    nodes(k) = std::cos(angle);
    for (int n = 0; n < order; ++n) densities(k, n) = M_PI / (order + 1) * sine * std::sin((n + 1) * angle);
  }
  for (int i = 0; i <= order; ++i) {
    const double angle = M_PI * (i + 0.5) / (order + 1);
    points(i) = std::cos(angle);
    for (int n = 0; n <= order; ++n) images(i, n) = std::cos(n * angle);
  }
}

ChebyshevFit::ChebyshevFit(int count) : nodes(count), from_values(count, count) {
  for (int node = 0; node < count; ++node) {
    const double angle = M_PI * (node + 0.5) / count;
    nodes(node) = std::cos(angle);
    for (int k = 0; k < count; ++k) from_values(k, node) = (k == 0 ? 1.0 : 2.0) / count * std::cos(k * angle);
  }
}

const ChebyshevRule& chebyshev_rule(int order) { return kept_for_thread<ChebyshevRule>(order); }

const ChebyshevFit& chebyshev_fit(int count) { return kept_for_thread<ChebyshevFit>(count); }

Eigen::VectorXd chebyshev_images(double t, int count) {
  Eigen::VectorXd values(count);
  if (std::abs(t) > 1) {
    const double root = std::sqrt((std::abs(t) - 1) * (std::abs(t) + 1));
    const double factor = std::copysign(1 / (std::abs(t) + root), t);
    double power = 1;
    for (int n = 0; n < count; ++n, power *= factor) values(n) = power;
    return values;
  }
  for (int n = 0; n < count; ++n) values(n) = n == 0 ? 1 : n == 1 ? t : 2 * t * values(n - 1) - values(n - 2);
  return values;
}

Eigen::RowVectorXd logarithm_missed(int order, double t) {
  // With f = sum f_m U_m the integral is sum f_m lambda_m, lambda_m' = pi T_{m+1}; f_m is a sum over nodes.
  const ChebyshevRule& rule = chebyshev_rule(order);
  const Eigen::VectorXd images = chebyshev_images(t, order + 2);
  Eigen::RowVectorXd integrals(order);  // 2/pi lambda_m
  integrals(0) = 0.5 * images(2) - std::log(2 * (std::abs(t) > 1 ? std::abs(images(1)) : 1));
  for (int m = 1; m < order; ++m) integrals(m) = images(m + 2) / (m + 2) - images(m) / m;
  const Eigen::VectorXd weights = rule.densities.col(0);
  const Eigen::RowVectorXd sums = integrals * rule.densities.transpose();
  return sums.array() / weights.transpose().array() - (t - rule.nodes.transpose().array()).abs().log();
}

}  // namespace rollres
