#pragma once

/// The answer of the Newton method on grids: of the spacing that is given, of the usual one, or as fine as a tolerance
/// asks.

#include "core/model/contact_model.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

/// Nodes in contact beyond which a tolerance is given up.
int most_nodes(const ContactModel& model);

/// @param most_nodes in contact; beyond, a tolerance is given up
RollingSolution solve_on_grids(const ContactModel& model, int most_nodes);

}  // namespace rollres
