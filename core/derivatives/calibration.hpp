#pragma once

/// What must be known of an objective before its differences can be trusted: its noise, and how strongly it bends.

#include <array>
#include <span>
#include <vector>

#include "core/derivatives/objective.hpp"

namespace rollres {

/// What is known of the objective along one input.
struct InputCalibration {
  double noise = RollingSolution::absent;  ///< standard deviation [unit of the output]; NaN: unknown
  /// Bounds of |f''|, |f'''|, |f''''| and |f^(5)| in the scaled variable [unit of the output].
  std::array<double, 4> derivatives{RollingSolution::absent, RollingSolution::absent, RollingSolution::absent,
                                    RollingSolution::absent};
  int evaluations = 0;
  std::vector<FailedPoint> failures = {};
};

struct Calibration {
  std::vector<double> point;  ///< where it was made [SI]
  ObjectiveValue centre;      ///< the objective there; without a value the inputs are unknown
  std::vector<InputCalibration> inputs;
};

/// Finds the noise (estimate_noise) and bounds of the higher derivatives along each input from a table of 9 values
/// with a wide spacing, which shows a grid that changes, and, where that is smooth, one of 7 with a fine spacing, which
/// shows rounding and unfinished iterations: 8 or 14 evaluations for each input, and one for the centre. A grid that
/// changes only farther away than the wide table reaches, 12 % of the input on either side, is not seen.
/// @param jobs threads, each with an input of its own; 0: one for each core
/// @throws std::invalid_argument if the point is outside the bounds
Calibration calibrate(const Objective& objective, std::span<const double> point, int jobs = 1);

}  // namespace rollres
