#pragma once

/// `method: active_set`: the combined algorithm of Zehil and Gavin (2013, sections 3.3 and 4.3).

#include "core/influence/influence.hpp"
#include "core/model/contact_model.hpp"
#include "core/scene/contact_state.hpp"

namespace rollres {

/// Solves the normal problem for given shear forces (normal_contact.hpp) and the tangential problem for given normal
/// forces (stick_slip.hpp) in turn, beginning without shear forces, until contact area and zones stay and no nodal
/// force changes by more than 1e-10 of the largest.
///
/// Only nodes of `candidate` can be in contact; contact at its border (or, for a sphere, in its first or last row)
/// ends the run with status not_converged and `reached_border` set. `iterations` counts the linear systems solved.
ContactState solve_active_set(const ContactModel& model, const InfluenceTable& table, const SurfaceGrid& candidate);

}  // namespace rollres
