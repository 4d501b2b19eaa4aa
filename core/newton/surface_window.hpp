#pragma once

/// The surface of the layer around a contact: displacements where no traction acts, and the velocity of the surface.

#include <vector>

#include "core/model/contact_model.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

/// Half-lengths of the contact over which a spectral solution keeps its fields, on either side of the contact.
constexpr double spectral_field_margin = 1.5;

/// Fields over the contact and `margin` times its half-length on all sides of it, on the nodes of the solution's grid
/// continued: the solution's tractions, zones and slip, zero and free beyond its grid, and the displacements that these
/// tractions cause (Zehil and Gavin 2013, eq. 5). Of a periodic layer half a period is shown at most. The fields of a
/// spectral solution, which are not sums over cells, are returned as they are.
/// @param solution with fields that have a node in contact
SurfaceFields surface_around(const ContactModel& model, const RollingSolution& solution, double margin);

/// Velocity of the layer's material at the surface, at each node [m/s]; y is empty for a cylinder.
struct SurfaceVelocity {
  std::vector<double> x, y;
};

/// -V du/dx and -V dv/dx (eq. 1), by the difference along x in which the solution's method has its slip: forward, and
/// the scene's slip_stencil for active_set; one-sided at the ends of the grid.
SurfaceVelocity surface_velocity(const ContactModel& model, const SurfaceFields& fields);

}  // namespace rollres
