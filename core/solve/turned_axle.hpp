#pragma once

/// A cylinder whose axle is turned to the left by a from across the travel.
///
/// Fields do not change along the axle, so that square to it, along X, the cylinder rolls at V cos a over layers that
/// remember along X alone; along the axle it slides at -V sin a. With F_X, F_Y and T of that frame, F_Y from the body
/// on the layer, and omega = R Omega/(V cos a), the power is V cos a (F_X + omega T/R - tan a F_Y).

#include <functional>

#include "core/model/contact_model.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

/// The answer at the skew at which the axial force asked for acts; that of `solve` where none is asked for.
/// @return no steady state where friction does not bear it
RollingSolution solve_at_own_skew(const ContactModel& model,
                                  const std::function<RollingSolution(const ContactModel&)>& solve);

/// From the frame of the axle, in which `model` was solved, to that of the travel: resistance and driving force along
/// it, the rotation over V, and the creepages; places, fields and losses stay.
void turn_to_travel(const ContactModel& model, RollingSolution& solution);

}  // namespace rollres
