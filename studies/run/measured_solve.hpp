#pragma once

/// One solution with what it cost: solved in a process of its own on one core, so that every solution is cold (no cache
/// filled by an earlier one), its peak memory its own, and a crash or a lack of memory a finding.

#include <limits>
#include <string>

#include "core/solve/rolling_contact.hpp"

namespace rollres {

struct Measurement {
  RollingSolution solution;                            ///< without its fields
  double seconds = RollingSolution::absent;            ///< wall time of the solution [s]
  double processor_seconds = RollingSolution::absent;  ///< much less than `seconds` on a busy machine [s]
  double peak_memory = RollingSolution::absent;        ///< resident, beyond what was so before the solution [B]
  bool stopped = false;                                ///< it took longer than the limit
  std::string failure;                                 ///< why there is no solution; empty: there is one
};

/// The waist of a measurement. The second argument is the limit [s] after which a solution is stopped.
using Measure = std::function<Measurement(const RollingScene&, double)>;

/// Solves a scene in a forked process. To be called while this process has one thread, and has solved nothing itself
/// where solutions shall be cold.
/// @throws std::runtime_error if no process can be started, or its answer cannot be heard
Measurement measured_solve(const Evaluate& evaluate, const RollingScene& scene,
                           double seconds_limit = std::numeric_limits<double>::infinity());

}  // namespace rollres
