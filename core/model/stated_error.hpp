#pragma once

/// How a solution states the error of its rolling resistance.

#include <cmath>

#include "core/scene/solution.hpp"

namespace rollres {

/// @param error of the rolling resistance [N] (per metre for a cylinder)
inline void set_error(double error, RollingSolution& solution) {
  solution.rolling_resistance_error = error;
  solution.error_estimate = error / std::abs(solution.rolling_resistance);
}

/// @param error relative to the rolling resistance
inline void add_error(double error, RollingSolution& solution) {
  solution.error_estimate += error;
  solution.rolling_resistance_error += error * std::abs(solution.rolling_resistance);
}

}  // namespace rollres
