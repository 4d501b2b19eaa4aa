#pragma once

/// A given pressure in steady motion over the layers, as a wheel's on a pavement: no body, no contact to be found.
///
/// The pressure, and a shear traction in proportion to it, is spread over cells by its exact part on each; their
/// displacements follow by convolution with the influence coefficients (core/influence). In the load's frame
///   R_r = integral of p dw/dx - tau du/dx,   w upwards,
/// is the power that the layers take, over V: the resistance that the layers' loss alone puts up. What slips or rolls
/// between a tyre and its road is no part of it. It is answered wave by wave (loss_by_waves.hpp); what the sum over the
/// cells misses of that is the energy_residual, large where memories are shorter than a cell.
///
/// Deflections are of second order in the cell, as cells see no place of the load within them: on two grids, of n and
/// about 2 n cells along the load, they are extrapolated, and what that changes tells their error.

#include "core/model/contact_model.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

/// @pre the model has a loaded area   @throws BeyondLimits, std::domain_error with the reason
RollingSolution solve_given_pressure(const ContactModel& model);

}  // namespace rollres
