#pragma once

/// A rule for sums over waves in the layers.

#include <Eigen/Core>

namespace rollres {

/// Wavenumbers k > 0 [1/m] with their weights.
struct InteriorWaves {
  Eigen::ArrayXd k, weight;
};

/// From 0 to `highest` by Gauss's rule on panels, `first` wide at 0 and `widest` at most [1/m].
InteriorWaves interior_waves(double first, double widest, double highest);

/// What is left of a wave of a sum that ends at the highest one: 1, and smoothly 0 there.
double faded(double wavenumber, double highest);

}  // namespace rollres
