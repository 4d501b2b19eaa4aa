#pragma once

/// The misfit of a fit near a point, as its slopes have it: a parabola of one parameter, the others at their best.

#include <Eigen/Core>
#include <optional>

#include "core/algebra/dense_algebra.hpp"
#include "fitting/descent/fit_problem.hpp"

namespace rollres {

/// How predictions bend along a way from the fit: the same on the other side of it.
struct Bend {
  double distance;         ///< of the parameter at the end of the way, signed, scaled
  Eigen::VectorXd misses;  ///< what the slopes at the fit miss there, whitened
};

/// The misfit near a point by its slopes, where one parameter moves and the others follow it.
class LocalParabola {
 public:
  /// @param misses  the residuals there   @param own  the parameter that moves
  LocalParabola(const FitProblem& problem, const Eigen::VectorXd& misses, const Slopes& slopes, Eigen::Index own);

  /// Square roots of the weights of the residuals over their deviations.
  const Eigen::VectorXd& whitening() const { return whitening_; }

  /// By how much the misfit falls if only the others move.
  double fall() const;

  /// How far this parameter must move, in a direction, for the least misfit to grow by `rise` in comparison with the
  /// least misfit here; NaN if it never does.
  double distance_to(double rise, double direction) const;

  /// The same with residuals that bend: misses * (distance / bend.distance)^2 more.
  double distance_to(double rise, double direction, const Bend& bend, double farthest) const;

  /// The step to the least misfit at this distance, scaled.
  Eigen::VectorXd step(double distance, const std::optional<Bend>& bend = {}) const;

 private:
  /// What the others cannot take away.
  Eigen::VectorXd left(const Eigen::VectorXd& misses) const;
  Eigen::VectorXd bent(double distance, const Bend& bend) const;

  Eigen::Index own_;
  Eigen::VectorXd whitening_, misses_, slope_;
  Eigen::MatrixXd others_;
  std::optional<SingularValues> decomposition_;  // of others_, if there are any
};

}  // namespace rollres
