#pragma once

/// Answers for points that have none: of parameters below whose least value scenes have no answer, as a friction
/// coefficient that the drive asks more of.

#include <vector>

#include "fitting/descent/fit_problem.hpp"

namespace rollres {

/// The problem that is asked beyond the least value of such a parameter (FitParameter::has_least) for its prediction at
/// that value, to 0.05 %, and says so in Prediction::taken_at: F(x, max(y, y_least(x))). The least misfit with
/// an answer is the least misfit of this problem.
/// @param held  parameters that keep their values
FitProblem with_nearest_answers(const FitProblem& problem, const std::vector<std::size_t>& held);

}  // namespace rollres
