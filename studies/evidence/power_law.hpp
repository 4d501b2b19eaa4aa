#pragma once

/// Statistics of what was measured: quantiles, power laws, and what a finer grid will cost.

#include <cstddef>
#include <limits>
#include <vector>

namespace rollres {

/// The smallest of the values that is not below a part of them, the median for 1/2; NaN of none.
double quantile(std::vector<double> values, double part);

/// y ~ x^slope.
struct PowerLaw {
  double slope = std::numeric_limits<double>::quiet_NaN();
  double deviation = std::numeric_limits<double>::quiet_NaN();  ///< standard error of the slope; NaN for two points
};

/// Least squares on logarithms of positive values; NaN for fewer than `fewest` points, or if all x are equal.
PowerLaw power_law(const std::vector<double>& x, const std::vector<double>& y, std::size_t fewest);

/// Seconds that a method takes, learnt as its spacing becomes finer.
class SolveCost {
 public:
  /// @param dimension of the surface: nodes ~ spacing^-dimension
  explicit SolveCost(double dimension) : dimension_(dimension) {}

  void add(double spacing, double seconds);
  /// Seconds at another spacing, from the growth over the last three, which is taken to lie between that of one
  /// operation for each node and that of dense elimination; NaN if nothing is known.
  double predicted(double spacing) const;

 private:
  double dimension_;
  std::vector<double> spacings_, seconds_;
};

}  // namespace rollres
