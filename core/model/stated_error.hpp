#pragma once

/// How a solution states the error of its rolling resistance.

#include <cmath>
#include <string>

#include "core/messages/message_text.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

/// @param error of the rolling resistance [N] (per metre for a cylinder)
inline void set_error(double error, RollingSolution& solution) {
  solution.rolling_resistance_error = error;
  solution.error_estimate = error == 0 ? 0 : error / std::abs(solution.rolling_resistance);
}

/// @param error relative to the rolling resistance
inline void add_error(double error, RollingSolution& solution) {
  solution.error_estimate += error;
  solution.rolling_resistance_error += error * std::abs(solution.rolling_resistance);
}

/// The warning that the stated error is more than a tolerance.
/// @param with  of what size: "31 nodes"   @param why  no more was done, or what the error is made of
inline std::string tolerance_missed(double tolerance, const RollingSolution& solution, const std::string& with = {},
                                    const std::string& why = {}) {
  return message_text("the tolerance ", tolerance, " was not reached", with.empty() ? "" : " with ", with,
                      ": estimated error ", solution.error_estimate, why.empty() ? "" : "; ", why);
}

}  // namespace rollres
