#pragma once

/// The way down to the least misfit: Levenberg and Marquardt's method within bounds, by Ceres.

#include <atomic>
#include <cstddef>
#include <string>
#include <vector>

#include "fitting/descent/fit_problem.hpp"

namespace rollres {

struct DescentOptions {
  int most_iterations = 60;
  double tolerance = 1e-7;                  ///< least relative change of the misfit that is worth another step
  double radius = 100;                      ///< of the first step, over the scale of each slope: large near the end
  std::vector<std::size_t> held = {};       ///< parameters that keep their values
  const std::atomic<bool>* stop = nullptr;  ///< set from outside: give up
};

struct Descent {
  FitPoint start, end;
  double misfit;           ///< at the end; NaN if the start has no prediction
  Prediction prediction;   ///< at the end; or why there is none at the start
  bool stopped_by_itself;  ///< what Ceres calls convergence: no more progress, which is no proof of a least misfit
  std::string why;         ///< it stopped
  int iterations = 0;

  bool found() const { return prediction.found(); }
};

/// Points without a prediction are stepped back from; the best point seen is the end. No descent goes farther from its
/// start than a factor of 10^6.
Descent descend(const FitProblem& problem, const FitPoint& start, const DescentOptions& options = {});

}  // namespace rollres
