#pragma once

/// Slopes that cost nothing: known ones, carried on from prediction to prediction by secants.
///
/// Where predictions are positive it is the slopes of their logarithms that are carried on: resistances are nearly
/// products of powers of their inputs.
/// @see Broyden (1965), Math. Comp. 19, 577

#include <functional>
#include <limits>
#include <memory>
#include <optional>

#include "fitting/descent/fit_problem.hpp"

namespace rollres {

/// A point with its prediction and slopes.
struct KnownSlopes {
  FitPoint point;
  Prediction prediction;
  Slopes slopes;
};

/// Known slopes carried on to another point.
/// @param share  1: so that they foretell the way back (Broyden); 2: so that a parabola through both points has the
///               slope known at the first one there, and theirs at the second
/// @return with the part of the change of the predictions, in their deviations, that the known slopes did not foretell
struct CarriedSlopes {
  KnownSlopes slopes;
  double missed;
};
CarriedSlopes carried_to(const FitPoint& point, const Prediction& prediction, const KnownSlopes& known,
                         const FitProblem& problem, double share = 1);

/// Where slopes come from that secants do not give.
struct SecantOptions {
  std::optional<KnownSlopes> known = {};  ///< to begin with; else they are evaluated at the first point
  /// The part of a change of predictions that known slopes may miss before slopes are evaluated anew.
  double trusted_miss = std::numeric_limits<double>::infinity();
  /// In place of the problem's own slopes where some are evaluated.
  std::function<Slopes(const FitPoint&, const Prediction&)> evaluate = {};
  std::shared_ptr<std::optional<KnownSlopes>> latest = {};  ///< gets the slopes of the last point, if it is there
};

/// The same problem with slopes by secants. It is for one descent after the other, not for two at a time.
FitProblem with_secants(const FitProblem& problem, SecantOptions options = {});

}  // namespace rollres
