#pragma once

/// What a number that scatters is: mean, standard deviation, quantiles and probabilities, each with its own error.
///
/// The values come in batches, which are independent of each other: points of Sobol' scrambled anew, or Latin
/// hypercubes drawn anew. An estimate is that of all values together. Its error is found by sectioning (Asmussen and
/// Glynn, 2007, "Stochastic Simulation", section III.5a; Nakayama, 2014, ACM Trans. Model. Comput. Simul. 24, 19): with
/// q_j the estimate of batch j of b, S^2 = sum (q_j - q)^2 / (b - 1) and the half-width of the 95 % interval
/// t_{b-1} S / sqrt(b). It needs no knowledge of how fast points of low discrepancy converge.

#include <cstddef>

#include <vector>

namespace rollres {

/// Values of one number, batch by batch. NaN where a point has no answer: it is left out, and counted.
using ScatterBatches = std::vector<std::vector<double>>;

struct ScatterEstimate {
  double value;
  double error;  ///< half-width of its 95 % interval; NaN with one batch, or if a batch has no value
};

struct ScatterStatistics {
  std::size_t values = 0, without = 0;  ///< points with a value, and without one
  ScatterEstimate mean{}, deviation{};  ///< standard deviation, over n - 1
  std::vector<ScatterEstimate> quantiles;
};

/// @param probabilities  of the quantiles, between 0 and 1
ScatterStatistics scatter_statistics(const ScatterBatches& batches, const std::vector<double>& probabilities);

/// Of values that are all there; the standard deviation is over n - 1, NaN for fewer than two.
double mean_value(const std::vector<double>& values);
double deviation_of(const std::vector<double>& values);

/// Mean of the values.
ScatterEstimate mean_of(const ScatterBatches& batches);

/// The quantile at a probability of sorted values x_1 <= ... <= x_n: x_i has the probability (i - 1/2) / n, those
/// between lie on a straight line (Hazen, 1914; definition 5 of Hyndman and Fan, 1996, Am. Stat. 50, 361).
double quantile_of_sorted(const std::vector<double>& sorted, double probability);

/// A quantile that is smooth in each value: the mean of the order statistics with the weights of Harrell and Davis
/// (1982, Biometrika 69, 635), those of a beta distribution with parameters (n + 1) p and (n + 1) (1 - p).
double smooth_quantile(std::vector<double> values, double probability);

/// A bar of a histogram: the share of the values from `from` to `to` [1].
struct HistogramBin {
  double from, to, share;
};

/// Bins as wide as Freedman and Diaconis have them (1981, Z. Wahrscheinlichkeitstheorie 57, 453), between 5 and 60.
/// Values that are all the same make one bin.
std::vector<HistogramBin> histogram_of_sorted(const std::vector<double>& sorted);

/// All values that there are, rising.
std::vector<double> sorted_values(const ScatterBatches& batches);

}  // namespace rollres
