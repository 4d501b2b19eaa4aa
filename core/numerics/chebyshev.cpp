#include "core/numerics/chebyshev.hpp"

#include <cmath>
#include <map>
#include <memory>

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

const ChebyshevRule& chebyshev_rule(int order) {
  thread_local std::map<int, std::unique_ptr<ChebyshevRule>> rules;
  std::unique_ptr<ChebyshevRule>& rule = rules[order];
  if (!rule) rule = std::make_unique<ChebyshevRule>(order);
  return *rule;
}

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

}  // namespace rollres
