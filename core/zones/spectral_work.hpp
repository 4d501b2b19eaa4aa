#pragma once

/// Work that is spent on continuous edges before the scene is left to the grids: counted and not timed, so that the
/// answer is the same on any machine.

#include "core/spectral/spectral_system.hpp"

namespace rollres {

/// In evaluations of a system of 100 unknowns with slip in one direction: 0.1 to 0.2 s.
inline constexpr double most_work = 800;
/// Times as much where a grid would need so much more: compressible layers and inertia.
inline constexpr double graded_share = 4;
/// And a tenth where a ring that remembers is sheared and no tolerance is asked for. (Of 80 random coated wheels 33 are
/// solved within it, 34 with all of the work.)
inline constexpr double share_of_rings = 0.1;

/// Work of an evaluation. Systems with slip in both directions take a base of their own (sliding_base.hpp) and, for the
/// resultants, several times as many sources.
double work_of(const SpectralProblem& problem, const SlipPattern& pattern, int order);

/// Work of checking all laws, on points between those of the collocation: for memories much shorter than the contact
/// most of it goes into their tails.
double work_of_check(const SpectralProblem& problem, const SlipPattern& pattern, int order, double half_length);

}  // namespace rollres
