#pragma once

/// Slopes that cost nothing: known ones, carried on from prediction to prediction by secants.
/// @see Broyden (1965), Math. Comp. 19, 577

#include <optional>

#include "fitting/fit_problem.hpp"

namespace rollres {

/// A point with its prediction and slopes.
struct KnownSlopes {
  FitPoint point;
  Prediction prediction;
  Slopes slopes;
};

/// The same problem with slopes by secants, from known ones on, or else from those at the first point that asks for
/// any. It is for one descent after the other, not for two at a time.
FitProblem with_secants(const FitProblem& problem, std::optional<KnownSlopes> known = {});

}  // namespace rollres
