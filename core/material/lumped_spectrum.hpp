#pragma once

/// Terms of a spectrum whose memory is too short or too long for a contact to tell them apart, as one.

#include <limits>

#include "core/material/material.hpp"

namespace rollres {

/// Times that a contact tells apart [s].
struct MemoryRange {
  double shortest = 0, longest = std::numeric_limits<double>::infinity();
  double unending = std::numeric_limits<double>::infinity();  ///< beyond which a memory is known by its rate alone
};

/// Of a contact that is resolved to `smallest` [m] and reaches over `largest` [m] at a speed [m/s]: short is a memory
/// below 1e-3 of the former, long one beyond 1e4 times the latter. Unending is one beyond 1e10 times the latter.
MemoryRange memory_range(double speed, double smallest, double largest);

/// The spectrum with all terms of times below the shortest as one, and all above the longest as another. The short one
/// has the compliance of its terms and their mean of time: 1/G* is met to second order in omega time. The long one has
/// their sums of compliance/time and of compliance ln(time)/time. These are all that a contact much shorter than V time
/// tells of long memories, to second order in its length over V time: over a rigid base the first, and on a half-space,
/// whose slope under a line force is 1/x, a mean of (ln(V time/x) - 0.577)/(V time) as well. Up to one term either way
/// is left as it is.
///
/// An unending memory keeps its compliance/time and takes the time of the limit: integrals over the memory are
/// truncated a hundred times farther. The logarithm above is then off by ln(time/limit), times compliance/(V time):
/// 1e-10 of the term's compliance at most.
///
/// At frequencies near 1/time of the long ones, and at rest, the compliance is another one. Quotients of compliances
/// must have the same one on both sides.
CreepSpectrum lumped(const CreepSpectrum& spectrum, const MemoryRange& range);

}  // namespace rollres
