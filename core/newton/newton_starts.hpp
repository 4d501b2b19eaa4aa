#pragma once

/// Ways to start the Newton method on one grid without a solution at hand, from the fastest to the safest.

#include "core/newton/contact_level.hpp"

namespace rollres {

/// Solves `problem` (the level's, or one with another drive or friction on the same grid) from a guess.
using NewtonStart = NewtonOutcome(const ContactProblem& problem, const ContactLevel& level,
                                  const ContactUnknowns& guess, const NewtonOptions& options);

/// Frictionless solution first, then with all contact nodes sticking.
NewtonStart solve_cold;

/// Follows the path of solutions over the rotation (rotation_path.hpp) in steps, until it passes the rotation given or
/// the drive's row changes its sign. For scenes that slide almost everywhere, where the coupled iteration alone wanders
/// among sets without a sticking node.
NewtonStart solve_by_rotation;

/// Solves the largest smaller friction that can be solved and follows the solution up to the friction wanted. For
/// spheres, whose pivots are dear.
NewtonStart solve_by_friction;

/// Follows the path of solutions from kink to kink, one way and then the other. For thin layers and friction near or
/// above one, where shear lifts or drags down much of the contact and the solution is not unique.
NewtonStart solve_by_pivots;

}  // namespace rollres
