#pragma once

/// A coating flows through the contact at R Omega, which may only be known with the answer.

#include <functional>

#include "core/model/contact_model.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

/// The answer at the flow that it gives itself: R Omega/V = f is the root of ratio(f) - f, found by secants. ratio(f)
/// hardly depends on f; the first solution takes R_r to change no more than in proportion to f. Where grids are tied to
/// the contact, a coarse one finds f first. Where the drive or the scene decides the flow, or nothing depends on it,
/// there is one solution.
/// @param full  model with nothing left out   @param solve_at  of such a model, simplified
RollingSolution solve_at_own_flow(const ContactModel& full,
                                  const std::function<RollingSolution(const ContactModel&)>& solve_at);

}  // namespace rollres
