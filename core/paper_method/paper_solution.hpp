#pragma once

/// The answer of the paper's method, with its error by a second solution at twice the spacing.

#include "core/model/contact_model.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

RollingSolution solve_paper(const ContactModel& model);

}  // namespace rollres
