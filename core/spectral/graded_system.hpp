#pragma once

/// The linear problem inside given edges and borders where pressure and shear are coupled in short waves: compressible
/// layers with friction, and inertia (core/spectral/README.md, section 9).

#include "core/algebra/nearby_systems.hpp"
#include "core/spectral/graded_tractions.hpp"

namespace rollres {

/// @param nearby  of former evaluations; takes over this one
SpectralState solve_graded(const SpectralProblem& problem, const SlipPattern& pattern, const SpectralEdges& edges,
                           const SpectralOrders& orders, NearbySystems& nearby);

/// How the rule's error falls with the order, in proportion [1].
double graded_tail(double order);
/// Violation of laws between the nodes at an order, at most, as met with in solutions [1].
double graded_field_error(double order);

}  // namespace rollres
