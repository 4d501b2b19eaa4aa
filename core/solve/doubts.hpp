#pragma once

/// Whether what a method calls an answer is one, and how far it is to be believed.

#include <optional>
#include <string>

#include "core/model/contact_model.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

/// An answer that is none, for a reason.
RollingSolution without_answer(Method method, Status status, std::string reason);

/// Why an answer that its method calls converged is none; empty if it is one.
std::string doubt(const ContactModel& model, const RollingSolution& solution);

/// Why an answer that holds the laws says nothing of the rolling resistance; empty if it does, or where the resistance
/// is none beside the lever of the load, as an elastic layer's.
std::string unknown_resistance(const ContactModel& model, const RollingSolution& solution);

/// What the expansion of memories in fixed times, on grids of composite surfaces, changes R_r by at most [1].
double expansion_share(const ContactModel& model, const RollingSolution& solution);

/// Whether the error stated is more than a tolerance asks for; an elastic layer resists with nothing.
bool misses_tolerance(const ContactModel& model, const std::optional<double>& tolerance,
                      const RollingSolution& solution);

/// Takes what the evidence says into the stated error: power gained where no passive layer gives any, and what the
/// balance of power misses.
void take_evidence(const ContactModel& model, RollingSolution& solution);

}  // namespace rollres
