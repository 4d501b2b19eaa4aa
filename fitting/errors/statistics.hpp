#pragma once

/// Distributions and tests of the statistics of fits.

#include <Eigen/Core>

namespace rollres {

/// Probability that chi squared of so many degrees of freedom exceeds `value`.
double chi_squared_tail(double value, int degrees);

/// The t with |Student's t| < t in a fraction `confidence` of cases; degrees 0: of the normal distribution.
double two_sided_quantile(double confidence, int degrees);

/// The runs test of Wald and Wolfowitz (1940): how probable it is that residuals of random signs change sign as rarely,
/// or as often, as these; 1 if there are fewer than 4 of either sign. Small after a systematic misfit.
/// @param residuals in an order in which a misfit would show
double runs_test(const Eigen::VectorXd& residuals);

}  // namespace rollres
