#pragma once

/// What a coating on the body takes: its part of the surface's displacements on a grid, M of core/newton/README.md,
/// (N3b), and what the linearised drive has of it.

#include "core/convolution/influence_operator.hpp"
#include "core/newton/contact_problem.hpp"
#include "core/newton/law_rows.hpp"
#include "core/newton/newton_system.hpp"

namespace rollres {

/// The coating's part of the displacements; empty without one.
Displacements moved_coating(const InfluenceOperator& influence, const ContactUnknowns& x);

/// M = sum A p c_x, c_x by central differences, so that an elastic coating takes nothing by itself [N]; 0 without one.
double coating_moment(const ContactProblem& problem, const InfluenceOperator& influence, const ContactUnknowns& x);

/// The derivative of M times what the drive's row has of it; empty where it has nothing.
TractionRow coating_in_drive_row(const ContactProblem& problem, const InfluenceOperator& influence,
                                 const ContactUnknowns& x);

/// The same of M alone. @pre there is a coating
TractionRow moment_row(const ContactProblem& problem, const InfluenceOperator& influence, const ContactUnknowns& x);

}  // namespace rollres
