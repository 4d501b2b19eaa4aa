#pragma once

/// What an answer says of itself: its model in words, and what to beware of.

#include <string>
#include <vector>

#include "core/estimate/assumptions.hpp"
#include "core/model/contact_model.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

/// What the model leaves out and why, with the number that justifies it.
std::string model_of(const ContactModel& model, const RollingSolution& solution);

/// Warnings about the scene and its solution: strain, slope, inertia, resolution, materials, period.
/// @param assumed  what the model rests on
std::vector<std::string> warnings_for(const ContactModel& model, const RollingSolution& solution,
                                      const std::vector<Assumption>& assumed);

/// Those about the layers' materials alone, which hold without an answer, too.
void warn_of_materials(const ContactModel& model, std::vector<std::string>& warnings);

/// Why a tolerance has no answer, or the one found without inertia is none: its layers' inertia counts, but the body is
/// faster than their waves. Empty otherwise.
std::string unanswered_inertia(const ContactModel& model);
std::string unanswered_inertia(const ContactModel& model, const RollingSolution& solution);

}  // namespace rollres
