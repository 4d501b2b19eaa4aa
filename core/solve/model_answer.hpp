#pragma once

/// The answer to a linear model: simplified as its tolerance allows, solved by its method at the flow of its coating,
/// judged, with its errors and its warnings.

#include "core/model/contact_model.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

/// @param full  with nothing left out   @throws BeyondLimits, std::domain_error, std::bad_alloc
RollingSolution solve_model(const ContactModel& full);

}  // namespace rollres
