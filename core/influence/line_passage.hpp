#pragma once

/// Influence coefficients of a cylinder in a single passage over any layered surface.
///
/// Short waves see half-spaces of the materials next to the contact, whose response to a cell is known for any memory
/// (passage_kernel.hpp). What the layers add is a smooth function of the distance, a Fourier integral of the compliance
/// itself at the frequencies of the passage (core/influence/README.md, (K9)): nothing is expanded. With inertia the
/// half-spaces' response is expanded in fixed retardation times (medium_expansion.hpp).

#include "core/influence/influence.hpp"
#include "core/model/contact_surface.hpp"

namespace rollres {

/// @param scene of a cylinder, without period
InfluenceTable line_passage_table(const ContactModel& model, const SurfaceGrid& grid, int reach_x);

/// Largest relative error of the expansion that it contains: 0 without inertia.
double line_expansion_error(const ContactModel& model);

}  // namespace rollres
