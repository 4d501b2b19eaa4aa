#pragma once

/// The end of an interval by profile likelihood from two or three predictions, where the misfit is nearly a parabola.
///
/// At each point the slopes, carried on by secants, say where on the parabola through it the misfit has risen to the
/// threshold while the other parameters make it least; the next point lies there.
/// @see Venzon and Moolgavkar (1988), J. R. Stat. Soc. C 37, 87

#include <optional>

#include "core/numerics/dense_algebra.hpp"
#include "fitting/descent/secant_slopes.hpp"
#include "fitting/errors/profile_likelihood.hpp"

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
  double fall() const { return misses_.squaredNorm() - left(misses_).squaredNorm(); }

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

struct QuickEnd {
  double distance;     ///< of the end, scaled, > 0
  ProfilePoint point;  ///< the last one of the profile that was met
  Bend bend;
};

/// What is asked for: one end of the interval of one parameter.
struct ProfileSide {
  const FitProblem& problem;
  const Descent& fit;
  const Slopes& slopes;
  const FitErrors& errors;
  std::size_t parameter;
  double direction;  ///< -1 or 1
  double threshold;
};

/// Nothing where the misfit is no parabola, or ends before the threshold at a bound or without a prediction.
std::optional<QuickEnd> quick_end(const ProfileSide& side, double limit, const std::optional<Bend>& other_side);

}  // namespace rollres
