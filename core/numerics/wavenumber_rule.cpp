#include "core/numerics/wavenumber_rule.hpp"

#include <algorithm>

#include "core/numerics/quadrature.hpp"
#include "core/numerics/solution_limits.hpp"

namespace rollres {

std::vector<double> distance_panels(double end) {
  constexpr double growth = 1.6;
  std::vector<double> borders{0, 1.5, 3.5, 6.5, 11};
  while (borders.back() < end) borders.push_back(borders.back() * growth);
  return borders;
}

WavenumberRule::WavenumberRule(double lowest, double highest, double r0, double r1, int order) {
  const WavenumberFade fade(r0, order);
  const double end = std::min(highest, fade.to);
  double from = 0;
  for (double to = lowest; from < end; from = to, to *= 1.6) {
    to = std::min(to, end);
    const QuadratureRule gauss = gauss_legendre(10 + checked_count(0.5 * (to - from) * r1, "nodes of a transform"));
    for (std::size_t q = 0; q < gauss.nodes.size(); ++q) {
      const double k = from + (to - from) * gauss.nodes[q];
      nodes.push_back(k);
      weights.push_back((to - from) * gauss.weights[q] * fade(k));
    }
  }
}

}  // namespace rollres
