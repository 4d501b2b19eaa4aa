#include "core/numerics/nonnegative_least_squares.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "core/numerics/dense_algebra.hpp"

namespace rollres {

Eigen::VectorXd nonnegative_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  const Eigen::Index n = a.cols();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
  if (n == 0) return x;
  std::vector<Eigen::Index> free;
  const double negligible = 1e-12 * (a.transpose() * b).cwiseAbs().maxCoeff();
  std::vector<char> refused(static_cast<std::size_t>(n), 0);  // came back at once, nothing having moved since
  for (Eigen::Index round = 0; round < 3 * n; ++round) {
    const Eigen::VectorXd gradient = a.transpose() * (b - a * x);
    Eigen::Index steepest = -1;
    for (Eigen::Index j = 0; j < n; ++j)
      if (x[j] == 0 && !refused[static_cast<std::size_t>(j)] && gradient[j] > negligible &&
          (steepest < 0 || gradient[j] > gradient[steepest]))
        steepest = j;
    if (steepest < 0) break;
    free.push_back(steepest);
    const Eigen::VectorXd before = x;
    while (!free.empty()) {
      const Eigen::VectorXd wanted = least_squares(a(Eigen::all, free), b);
      double part = 1;  // of the way from x to what is wanted, so far as nothing turns negative
      for (std::size_t k = 0; k < free.size(); ++k)
        if (const auto i = static_cast<Eigen::Index>(k); wanted[i] <= 0)
          part = std::min(part, x[free[k]] / (x[free[k]] - wanted[i] + std::numeric_limits<double>::min()));
      std::vector<Eigen::Index> kept;
      for (std::size_t k = 0; k < free.size(); ++k) {
        const auto i = static_cast<Eigen::Index>(k);
        const double value = x[free[k]] + part * (wanted[i] - x[free[k]]);
        const bool stays = part == 1 || (wanted[i] > 0 && value > 0);
        x[free[k]] = stays ? value : 0;
        if (stays) kept.push_back(free[k]);
      }
      const bool done = part == 1;
      free = std::move(kept);
      if (done) break;
    }
    if (x == before)
      refused[static_cast<std::size_t>(steepest)] = 1;
    else
      std::fill(refused.begin(), refused.end(), char{0});
  }
  return x;
}

}  // namespace rollres
