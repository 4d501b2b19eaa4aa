#pragma once

/// What the slopes at a fit say of the errors of its parameters, in scaled variables.

#include <Eigen/Core>
#include <vector>

#include "fitting/descent/fit_problem.hpp"

namespace rollres {

/// Where a parameter ended.
enum class AtBound { no, lowest, highest };

/// Linear errors at a point: with A the whitened slopes (a row for each residual, times the root of its loss's
/// weight), the covariance is scale (A^T A)^-1. Parameters at a bound that the misfit presses against are held: their
/// rows and columns are NaN.
struct FitErrors {
  double scale;  ///< variance of a residual: 1 where deviations are known, else misfit / degrees, without priors
  std::vector<AtBound> at_bound;
  Eigen::MatrixXd covariance;  ///< scaled variables; infinite where slopes leave a direction free
  Eigen::VectorXd deviations;  ///< roots of its diagonal: relative standard errors of positive quantities
  Eigen::MatrixXd correlations;
  double condition;                      ///< largest over smallest singular value of A; infinite if a direction is free
  Eigen::VectorXd weakest;               ///< unit vector of the smallest singular value; 0 for held parameters
  double weakest_deviation;              ///< standard deviation along it; infinite if free
  Eigen::MatrixXd directions;            ///< all such unit vectors, a column each, the best known first
  Eigen::VectorXd direction_deviations;  ///< standard deviations along them
  Eigen::VectorXd step;                  ///< Gauss and Newton's from here: where the least misfit is thought to be
  double fall;                           ///< of the misfit, that this step promises
  /// For each parameter the estimated error of its column of A over the column: from 1 on, slopes are noise.
  Eigen::VectorXd slope_doubt;
  /// The same error in standard deviations of the data, for a change of the scaled parameter by 1: a slope whose error
  /// is less than these is that of a parameter which the data hardly feel, and no matter of noise.
  Eigen::VectorXd slope_errors;
};

/// @throws std::invalid_argument if the data are fewer than the parameters, or as many while deviations are unknown
void require_enough_data(const FitProblem& problem);

/// @throws std::invalid_argument as require_enough_data
FitErrors fit_errors(const FitProblem& problem, const FitPoint& point, const Eigen::VectorXd& residuals,
                     const Slopes& slopes);

/// Degrees of freedom: data less parameters.
int degrees_of_freedom(const FitProblem& problem);

}  // namespace rollres
