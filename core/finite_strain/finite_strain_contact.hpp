#pragma once

/// Rolling of a cylinder on layers, or of a covered one on a rigid plane, whose displacements and strains are not
/// small. Theory: core/finite_strain/README.md.

#include <string>

#include "core/model/contact_model.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

/// The wanted relative error of the rolling resistance of a scene without a tolerance.
constexpr double default_finite_tolerance = 1e-3;

/// Solves on finer and finer meshes until two of them, and the two ways to tell the resistance, agree.
/// @param model of method finite_strain
/// The solution's status is converged, no_steady_state or not_converged; seconds and warnings are left to the caller,
/// `model` says what it should add.
RollingSolution solve_finite_strain(const ContactModel& model);

}  // namespace rollres
