#pragma once

/// The pattern of zones that follows from what is wrong with a solution of another one.

#include <optional>
#include <span>

#include "core/zones/spectral_solution.hpp"
#include "core/zones/spectral_start.hpp"

namespace rollres {

/// A stick slips where it would be overloaded. Where slip would be against its shear the body slips the other way, next
/// to a short stick, if that is at one end of the zone, and sticks if it is in the middle; a zone that is wrong
/// throughout turns round, or goes between two sticks.
/// @param runs of `assess(problem, state)`, from the leading edge on, to be mended together
/// @return none where wrong points adjoin a border that the search has to move, no stick would be left, or two runs
/// would both cut one zone
std::optional<PatternStart> mended(const SpectralProblem& problem, const SpectralState& state,
                                   std::span<const WrongRun> runs);

}  // namespace rollres
