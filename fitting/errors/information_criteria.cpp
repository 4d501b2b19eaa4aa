#include "fitting/errors/information_criteria.hpp"

#include <cmath>
#include <limits>

namespace rollres {

InformationCriteria information_criteria(double chi_squared, std::size_t values, int parameters, bool scale_known,
                                         double log_variances) {
  const auto n = static_cast<double>(values);
  const double k = parameters + (scale_known ? 0 : 1);
  const double likelihood = log_variances + (scale_known ? chi_squared : n * std::log(chi_squared / n));
  return {likelihood,
          n - k - 1 > 0 ? likelihood + 2 * k + 2 * k * (k + 1) / (n - k - 1) : std::numeric_limits<double>::infinity(),
          likelihood + k * std::log(n)};
}

}  // namespace rollres
