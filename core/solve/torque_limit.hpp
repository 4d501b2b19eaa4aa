#pragma once

/// Torques that no contact can pass on, told without solving, or from a coarse grid on which everything slides.

#include <string>

#include "core/model/contact_model.hpp"

namespace rollres {

/// The largest torque that friction can give under the scene's load wherever the body touches within
/// `widest_window` [N] (per metre for a cylinder: [N m/m]); infinite where the load is not given, the surface sticks by
/// adhesion, or (printed kinematics of a cylinder) friction may carry the load by itself.
double largest_torque(const ContactModel& model);

/// Why a drive by torque has no steady state if it asks for more than that, or, of a cylinder with printed kinematics,
/// for three times what sliding gives; empty if it does not.
std::string unbearable_torque(const ContactModel& model);

}  // namespace rollres
