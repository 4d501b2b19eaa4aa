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

/// Whether grids are tied to the contact, so that there is a coarse one: no spacing is given.
bool has_coarse_grid(const ContactModel& model);

/// On a coarse grid tied to the contact, for where a search may begin: R_r and rotation to a few per cent or better.
RollingSolution solve_on_coarse_grid(const ContactModel& model);

}  // namespace rollres
