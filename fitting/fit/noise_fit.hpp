#pragma once

/// Fits to measured values whose noise is not known beforehand: it is a part of what is fitted,
///
///     variance of a value = sum over the terms that act on it of level^2, or (part * prediction)^2.
///
/// Parameters by weighted least squares and terms by their restricted likelihood, in turns, until neither moves. The
/// restricted likelihood minds what each residual has lost to the fitted parameters: with weights W = 1/variance and
/// slopes X it is that of the residuals which X cannot follow,
///
///     -2 ln L = sum ln variance + ln det(X^T W X) + r^T W r.
///
/// The errors of the parameters know that the sizes of the terms beside one another are estimated, too: for each term
/// but the one that tells most, the covariance and the way of the fit are averaged over that size by this likelihood,
/// the logarithm of the size being uniform beforehand. The size of all terms together is in Student's t.
/// @see Carroll and Ruppert (1988), Transformation and weighting in regression, sections 2.1 and 3.2;
///      Patterson and Thompson (1971), Biometrika 58, 545: the restricted likelihood

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "fitting/fit/fit.hpp"

namespace rollres {

inline constexpr std::string_view noise_level_key = "noise_level", relative_noise_key = "relative_noise";
inline bool is_noise_term(std::string_view key) { return key == noise_level_key || key == relative_noise_key; }

/// A term of the noise.
struct NoiseTerm {
  std::string name;
  bool relative;           ///< a part of the prediction; else a level in the unit of the values
  std::vector<bool> acts;  ///< on each datum
};

/// The terms that make residuals most likely; zero where a term explains nothing.
/// @param squares  of the residuals [SI], one for each datum, negative: it is no measurement
/// @param slopes   of the predictions [SI] by what was fitted, a row for each datum, over its deviation where that is
///                 no measurement; none: nothing was fitted
/// @see Zhou, Hu, Zhou and Lange (2019), J. Comput. Graph. Stat. 28, 350: the iteration, in which no step lowers the
/// likelihood
std::vector<LikelyNoise> likely_noise(const Eigen::VectorXd& squares, const Eigen::VectorXd& predictions,
                                      const std::vector<NoiseTerm>& terms, const Eigen::MatrixXd& slopes = {});

/// The fit, with report.noise_terms and errors as above. Deviations of the problem's data are replaced, but for those
/// of priors.
/// @throws std::invalid_argument as fit, or if no term acts on a datum
FitReport fit_with_noise(const FitProblem& problem, const std::vector<NoiseTerm>& terms, const FitOptions& options);

}  // namespace rollres
