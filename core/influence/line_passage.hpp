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

/// Turns of a ring until nothing is left of its longest memory, e^-30, or until what is left is the same along the
/// contact. @param alone the ring as a layer on a rigid base
int turns_felt(const ContactModel& alone);

/// ln|x| over the modulus as a half-space that creeps remembers it of a line force that has passed at a speed [1/Pa].
double remembered_logarithm(const CreepSpectrum& creep, double speed, double x);

/// Largest relative error of the expansion that it contains: 0 without inertia.
double line_expansion_error(const ContactModel& model);

}  // namespace rollres
