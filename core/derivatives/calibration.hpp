#pragma once

/// What must be known of an objective before its differences can be trusted: its noise, and how strongly it bends.

#include <span>
#include <vector>

#include "core/derivatives/formula.hpp"
#include "core/derivatives/objective.hpp"

namespace rollres {

/// What is known of the objective along one input, in units of the variable's own length (objective.hpp).
struct InputCalibration {
  FunctionSize size;  ///< [unit of the output]; NaN: unknown
  int evaluations = 0;
  std::vector<FailedPoint> failures = {};
};

struct Calibration {
  std::vector<double> point;  ///< where it was made [SI]
  ObjectiveValue centre;      ///< the objective there; without a value the inputs are unknown
  std::vector<InputCalibration> inputs;
};

/// Finds the noise (estimate_noise) and bounds of the higher derivatives along each input from a table of 9 values, at
/// first from -12 % to 12 % of the variable's own length. While that does not resolve the function or the noise,
/// further tables follow, each a tenth as wide, five at most. The one that promises the best derivative is taken, or,
/// where its derivative disagrees with that of wider ones, the narrower; steps then stay inside it. Jumps that are
/// small against what the function does over the table, or against the error that the solution states, are those of a
/// grid, and noise: then the wide table is taken, but not where solutions state errors below 1e-6, as continuous edges
/// do. Points known much worse than the centre are avoided where others are there.
///
/// 8 evaluations for each input and table, and one for the centre; mostly one table is enough. What changes only
/// farther away than the tables reach, or over less than a ten-thousandth of the own length, is not seen.
/// @param jobs threads, each with an input of its own; 0: one for each core
/// @throws std::invalid_argument if the point is outside the bounds
Calibration calibrate(const Objective& objective, std::span<const double> point, int jobs = 1);

}  // namespace rollres
