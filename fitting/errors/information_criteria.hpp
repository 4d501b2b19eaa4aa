#pragma once

/// What tells models of the same data apart.
///
/// With n values, k parameters and -2 ln L = chi squared (deviations known) or n ln(chi squared / n) (their common
/// scale is one parameter more):
///     AICc = -2 ln L + 2 k + 2 k (k + 1) / (n - k - 1),   BIC = -2 ln L + k ln n.
/// @see Hurvich and Tsai (1989), Biometrika 76, 297; Schwarz (1978), Annals of Statistics 6, 461

#include <cstddef>

namespace rollres {

struct InformationCriteria {
  double likelihood, aicc, bic;  ///< likelihood: -2 ln L; aicc infinite with too few values
};
/// @param parameters  fitted ones, without a common scale of the deviations, which is added where it is not known
/// @param log_variances  sum of the logarithms of the variances, where these differ between fits
InformationCriteria information_criteria(double chi_squared, std::size_t values, int parameters, bool scale_known,
                                         double log_variances = 0);

}  // namespace rollres
