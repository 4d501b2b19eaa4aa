#pragma once

/// The end of an interval by profile likelihood from two or three predictions, where the misfit is nearly a parabola.
///
/// At each point the slopes, carried on by secants, say where on the parabola through it the misfit has risen to the
/// threshold while the other parameters make it least; the next point lies there.
/// @see Venzon and Moolgavkar (1988), J. R. Stat. Soc. C 37, 87

#include <optional>

#include "fitting/descent/secant_slopes.hpp"
#include "fitting/errors/profile_likelihood.hpp"

namespace rollres {

/// How predictions bend along a way from the fit: the same on the other side of it.
struct Bend {
  double distance;         ///< of the parameter at the end of the way, signed, scaled
  Eigen::VectorXd misses;  ///< what the slopes at the fit miss there, whitened
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
