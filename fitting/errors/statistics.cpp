#include "fitting/errors/statistics.hpp"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace rollres {

double chi_squared_tail(double value, int degrees) {
  return boost::math::cdf(boost::math::complement(boost::math::chi_squared(degrees), value));
}

double two_sided_quantile(double confidence, int degrees) {
  const double tail = (1 - confidence) / 2;
  if (degrees == 0) return boost::math::quantile(boost::math::complement(boost::math::normal(), tail));
  return boost::math::quantile(boost::math::complement(boost::math::students_t(degrees), tail));
}

double runs_test(const Eigen::VectorXd& residuals) {
  constexpr double fewest = 4;
  double above = 0, below = 0, runs = 0;
  int last = 0;
  for (const double residual : residuals) {
    if (residual == 0) continue;
    const int sign = residual > 0 ? 1 : -1;
    (sign > 0 ? above : below) += 1;
    if (sign != last) ++runs;
    last = sign;
  }
  if (above < fewest || below < fewest) return 1;
  const double all = above + below, product = 2 * above * below;
  const double mean = product / all + 1;
  const double deviation = std::sqrt(product * (product - all) / (all * all * (all - 1)));
  const double distance = std::max(0.0, std::abs(runs - mean) - 0.5) / deviation;
  return std::erfc(distance / std::sqrt(2.0));
}

}  // namespace rollres
