#include "studies/scatter/correlation.hpp"

#include <Eigen/Eigenvalues>
#include <boost/math/distributions/normal.hpp>
#include <stdexcept>

#include "core/algebra/dense_algebra.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

Eigen::MatrixXd correlation_factor(std::size_t inputs, const std::vector<CorrelatedPair>& pairs) {
  if (pairs.empty()) return {};
  const auto size = static_cast<Eigen::Index>(inputs);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(size, size);
  for (const auto& [first, second, correlation] : pairs) {
    const auto i = static_cast<Eigen::Index>(first), j = static_cast<Eigen::Index>(second);
    matrix(i, j) = matrix(j, i) = correlation;
  }
  constexpr double least = 1e-12;  // of an eigenvalue: below it is rounding
  const double smallest = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues().minCoeff();
  if (smallest < least)
    throw std::invalid_argument("the correlations contradict each other: the smallest eigenvalue of their matrix is " +
                                short_number(smallest, 3) + ", it must be positive");
  return PositiveSystem(matrix).lower();
}

void correlate(std::vector<std::vector<double>>& uniform, const Eigen::MatrixXd& factor) {
  if (factor.size() == 0) return;
  const boost::math::normal standard;
  const auto size = static_cast<Eigen::Index>(uniform.size());
  Eigen::VectorXd z(size);
  for (std::size_t point = 0; point < uniform.front().size(); ++point) {
    for (Eigen::Index i = 0; i < size; ++i)
      z[i] = boost::math::quantile(standard, uniform[static_cast<std::size_t>(i)][point]);
    const Eigen::VectorXd together = factor * z;
    constexpr double last = 1 - 0x1p-53;  // below 1
    for (Eigen::Index i = 0; i < size; ++i)
      uniform[static_cast<std::size_t>(i)][point] = std::min(last, boost::math::cdf(standard, together[i]));
  }
}

}  // namespace rollres
