#include "core/interior/interior_waves.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/numerics/quadrature.hpp"
#include "core/numerics/solution_limits.hpp"

namespace rollres {

InteriorWaves interior_waves(double first, double widest, double highest) {
  constexpr int in_panel = 16;
  constexpr double growth = 7;  // of panels of long waves, over their distance from 0
  const QuadratureRule& rule = gauss_rule(in_panel);
  require_memory(highest / widest * in_panel * 2 * sizeof(double), "waves in the layers");
  std::vector<double> ends{0};
  for (double to = std::min(first, widest); to < highest; to += std::min(growth * to, widest)) ends.push_back(to);
  ends.push_back(highest);
  std::vector<double> k, weights;
  for (std::size_t panel = 1; panel < ends.size(); ++panel)
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double width = ends[panel] - ends[panel - 1];
      k.push_back(ends[panel - 1] + width * rule.nodes[i]);
      weights.push_back(width * rule.weights[i]);
    }
  const auto as_array = [](const std::vector<double>& values) {
    return Eigen::Map<const Eigen::ArrayXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  };
  return {as_array(k), as_array(weights)};
}

double faded(double wavenumber, double highest) {
  constexpr double from = 0.7, over = 0.3;  // of the highest
  if (wavenumber < from * highest) return 1;
  return 0.5 * std::erfc(7 * (2 * (wavenumber / highest - from) / over - 1));
}

}  // namespace rollres
