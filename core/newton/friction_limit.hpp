#pragma once

/// What friction can give at most, and what it can do to a body at most.

#include "core/model/contact_model.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

/// Whether sliding gives the traction that the scene's drive asks for.
enum class SlidingLimit { enough, not_enough, unknown };
SlidingLimit sliding_limit(const ContactModel& model, const SurfaceGrid& half_grid);

/// Least friction coefficient that gives the traction that the scene's drive asks for, on a given grid (the scene's own
/// if it suffices): when everything slides, or at a moderate rotation, where part of the contact sticks or is drawn
/// aside and friction may give more. NaN if that could not be found out.
double friction_needed(const ContactModel& model, const SurfaceGrid& half_grid);

/// The torque that friction gives, in the direction of the scene's own, when everything slides [N m] (per metre for a
/// cylinder: [N]); NaN if that could not be solved.
double sliding_torque(const ContactModel& model, const SurfaceGrid& half_grid);

/// Largest friction coefficient, within 0.5 %, under which the contact keeps clear of the body's edge, for a scene
/// under whose own it does not: where friction exceeds the cotangent of the surface's slope somewhere in the contact,
/// more pressure there bears less load, and the body digs itself in. NaN if less friction does not help.
double friction_borne(const ContactModel& model, const SurfaceGrid& half_grid);

}  // namespace rollres
