#pragma once

/// The numbers of scatter_statistics.hpp from a polynomial that was fitted to the points (polynomial_chaos.hpp), at as
/// many points as are wanted. Their errors are of two parts. One is that of other points: each batch is left out of the
/// fit in turn, and the half-width of the 95 % interval is t_{b-1} S with the jackknife's S^2 = (b - 1)/b sum (q_j -
/// q)^2 (Efron and Stein, 1981, Ann. Stat. 9, 586), and that of the many points by
/// sectioning. The other is what the polynomial misses everywhere, its error e of
/// cross-validation: a quantile of y lies as far from that of the polynomial as y does at most, the standard deviations
/// differ by no more than e, the means by 1.96 e / sqrt(n), as those of the differences at the points do.

#include <optional>

#include "studies/scatter/polynomial_chaos.hpp"
#include "studies/scatter/scatter_statistics.hpp"

namespace rollres {

/// Points at which numbers of a surrogate are taken, and those at which it is fitted, batch after batch.
struct SurrogatePoints {
  GermPoints fitted;
  Eigen::MatrixXd wanted;
  std::size_t wanted_batches = 8;  ///< of as many points each, independent of each other
};

struct SurrogateStatistics {
  ScatterEstimate mean{}, deviation{};
  std::vector<ScatterEstimate> quantiles;
  double error = 0;  ///< e over the standard deviation [1]
  int degree = 0;
  std::size_t terms = 0;
};

/// Nothing where a point has no value, or there are fewer than three batches or 16 points, or all values are the same.
std::optional<SurrogateStatistics> surrogate_statistics(const SurrogatePoints& points, const ScatterBatches& batches,
                                                        const std::vector<double>& probabilities);

/// How probable it is that the values are at most 0; its error holds the weight within 1.96 e of 0.
std::optional<ScatterEstimate> surrogate_probability(const SurrogatePoints& points, const ScatterBatches& batches);

/// Whether every number of the surrogate is surer than that of the points themselves.
bool is_surer(const SurrogateStatistics& surrogate, const ScatterStatistics& sampled);

}  // namespace rollres
