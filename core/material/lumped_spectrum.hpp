#pragma once

/// Terms of a spectrum whose memory is too short or too long for a contact to tell them apart, as one.

#include <limits>

#include "core/material/material.hpp"

namespace rollres {

/// Times that a contact tells apart [s].
struct MemoryRange {
  double shortest = 0, longest = std::numeric_limits<double>::infinity();
};

/// Of a contact that is resolved to `smallest` [m] and reaches over `largest` [m] at a speed [m/s]: short is a memory
/// below 1e-3 of the former, long one beyond 1e4 times the latter.
MemoryRange memory_range(double speed, double smallest, double largest);

/// The spectrum with all terms of times below the shortest as one, and all above the longest as another. Each has the
/// compliance of its terms, the short one their mean of time (1/G* is met to second order in omega time), the long one
/// their mean of 1/time (to second order in 1/(omega time)). Up to one term either way is left as it is.
///
/// Waves of a frequency near 1/time of the long ones see another compliance. Over a rigid base they do not move the
/// surface, but quotients of compliances must have it on both sides.
CreepSpectrum lumped(const CreepSpectrum& spectrum, const MemoryRange& range);

}  // namespace rollres
