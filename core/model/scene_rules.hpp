#pragma once

/// The rules a scene must keep, and the method that it asks for.

#include <string>
#include <vector>

#include "core/model/contact_model.hpp"
#include "core/numerics/solution_limits.hpp"

namespace rollres {

/// Every rule the scene breaks, each as one line "key = value: rule" (ranges, and what must go together:
/// load or approach, spacing or tolerance, driving_torque with drive torque, ...). Empty: the scene can be solved.
std::vector<std::string> check(const RollingScene& scene);

/// @throws std::invalid_argument with all of them if there are any
void require_valid(const RollingScene& scene);

/// The limits of a solution that the scene gives, or the usual ones, from now on.
SolutionLimits limits_of(const RollingScene& scene);

/// Whether the lowest layer is a half-space.
bool on_half_space(const RollingScene& scene);

/// Why the inside of the layers is not computed of a scene (core/interior): "not with a period"; empty if it is.
std::string why_no_interior(const RollingScene& scene);

/// Why method spectral cannot solve it, as the rule "key = value: rule" that it breaks; empty if it can.
std::string spectral_refusal(const ContactModel& model);

/// The method that solves the scene first: its own, or what `automatic` stands for.
Method resolved_method(const RollingScene& scene);

}  // namespace rollres
