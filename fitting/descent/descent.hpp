#pragma once

/// The way down to the least misfit: Levenberg and Marquardt's method within bounds, by Ceres.

#include <atomic>
#include <cstddef>
#include <string>
#include <vector>

#include "fitting/descent/fit_problem.hpp"

namespace rollres {

/// The radius of a descent from close by: Gauss and Newton's steps.
inline constexpr double radius_near_the_end = 1e6;

struct DescentOptions {
  int most_iterations = 60;
  double tolerance = 1e-7;                  ///< least relative change of the misfit that is worth another step
  double radius = 100;                      ///< of the first step, over the scale of each slope: large near the end
  double stride = 1;                        ///< largest change of a scaled parameter before bounds are drawn anew
  double rival = RollingSolution::absent;   ///< a misfit reached elsewhere: far above it, a slow descent is given up
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
  bool met_edge = false;   ///< a step led beyond the least value with an answer of a parameter (nearest_answer.hpp)
  bool abandoned = false;  ///< far above another's end, by some of the data: its misfit is an estimate

  bool found() const { return prediction.found(); }
};

/// Points without a prediction are stepped back from; the best point seen is the end. No step changes a parameter by
/// more than a stride either way, in the logarithm where it is positive: where data hardly feel one, Gauss and Newton
/// would send it off by orders of magnitude. Beyond the least value with an answer of a parameter that has one the
/// descent goes on at that value. No descent goes farther from its start than a factor of 10^6.
Descent descend(const FitProblem& problem, const FitPoint& start, const DescentOptions& options = {});

}  // namespace rollres
