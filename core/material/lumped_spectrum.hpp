#pragma once

/// Terms of a spectrum whose memory is too short or too long for a contact to tell them apart, as one.

#include "core/material/material.hpp"

namespace rollres {

/// The spectrum with all terms of times below `shortest` as one, and all above `longest` as another. Each has the
/// compliance of its terms, the short one their mean of time (1/G* is met to second order in omega time), the long one
/// their mean of 1/time (to second order in 1/(omega time)). Up to one term either way is left as it is.
/// @param shortest, longest [s]
CreepSpectrum lumped(const CreepSpectrum& spectrum, double shortest, double longest);

/// The same for a contact that is resolved to `smallest` [m] and reaches over `largest` [m] at a speed [m/s]: short is
/// a memory below 1e-3 of the former, long one beyond 1e4 times the latter.
CreepSpectrum lumped_for(const CreepSpectrum& spectrum, double speed, double smallest, double largest);

}  // namespace rollres
