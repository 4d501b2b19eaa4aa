#pragma once

/// Displacements along the axle of a cylinder under shear along it: antiplane shear of the layers, which moves nothing
/// else. Its symbol is c_tt of core/influence/README.md, (K1).

#include <vector>

#include "core/model/contact_model.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

/// C_vv of a cylinder in a single passage over any layered surface, at offsets of -reach_x to reach_x columns [m2/N]:
/// the half-spaces next to the contact by their creep, and what the layers add as in (K9).
/// @param model of a cylinder, without period
std::vector<double> axial_coefficients(const ContactModel& model, const SurfaceGrid& grid, int reach_x);

}  // namespace rollres
