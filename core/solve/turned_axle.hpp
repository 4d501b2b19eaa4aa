#pragma once

/// Bodies whose axle is turned to the left by a from across the travel.
///
/// Of a cylinder fields do not change along the axle, so that square to it, along X, the cylinder rolls at V cos a over
/// layers that remember along X alone; along the axle it slides at -V sin a. With F_X, F_Y and T of that frame, F_Y
/// from the body on the layer, and omega = R Omega/(V cos a), the power is V cos a (F_X + omega T/R - tan a F_Y).

#include <functional>

#include "core/model/contact_model.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

/// The answer at the skew at which the side force asked for acts, a cylinder's along its axle or a sphere's across the
/// travel; that of `solve` where none is asked for.
/// @return no steady state where friction does not bear it
RollingSolution solve_at_own_skew(const ContactModel& model,
                                  const std::function<RollingSolution(const ContactModel&)>& solve);

/// From the frame of the axle, in which `model` was solved, to that of the travel: resistance and driving force along
/// it, the rotation over V, and the creepages; places, fields and losses stay. A sphere's model is in that of the
/// travel: it gains the skew, the creepages and the spin.
void turn_to_travel(const ContactModel& model, RollingSolution& solution);

}  // namespace rollres
