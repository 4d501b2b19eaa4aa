#pragma once

/// Numbers that scatter together: the Gaussian copula (Nelsen, 2006, "An Introduction to Copulas", section 2.3). With z
/// standard normal numbers of correlation matrix C = L L^T, each x_i is the quantile of its own distribution at
/// Phi(z_i): whatever the distributions, C tells how they hang together. For normal numbers C is their correlation, for
/// lognormal ones that of their logarithms.

#include <Eigen/Core>
#include <string>
#include <vector>

namespace rollres {

/// A pair of inputs that scatter together, by their places.
struct CorrelatedPair {
  std::size_t first, second;
  double correlation;  ///< of the normal numbers, from -1 to 1, neither included
};

/// The lower triangle L; empty without pairs.
/// @throws std::invalid_argument if the matrix is not positive definite: the pairs contradict each other
Eigen::MatrixXd correlation_factor(std::size_t inputs, const std::vector<CorrelatedPair>& pairs);

/// Makes independent uniform numbers in (0, 1), one list for each input, correlated ones.
/// @param factor  of correlation_factor
void correlate(std::vector<std::vector<double>>& uniform, const Eigen::MatrixXd& factor);

}  // namespace rollres
