#pragma once

/// What the linear theory misses of a cylinder's rolling resistance where displacements and strains are not small.
///
/// With R_r at finite strain as core/finite_strain/README.md defines it (neo-Hooke, overstresses linear in the second
/// Piola-Kirchhoff stress; another law of finite viscoelasticity gives another number) and the linear one under the
/// same load,
///   ln(R_r finite / R_r linear) = d/H (b_0 + sum_j b_j X_j),  X_j products of
///   A = a/(a + H),  U = (1 + d ln G''/d ln omega)/2,  T = tan delta/(1 + tan delta),  M = mu/(mu + 0.1),
///   C = 1 - 2 nu,  K = C (a/H)^2/(0.3 + C (a/H)^2),  S = d/H,
/// a half the length of the contact, G'' and tan delta at omega = V/a. The factors b are fitted to 718 drawn pairs of
/// solutions (tests/benchmark/linearity.py draws and fits them): 0.1 < a/H < 7, d/H < 0.33, nu >= 0.35, mu <= 0.8,
/// Zener and Prony solids.

#include <optional>

#include "core/model/contact_model.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

struct LinearityError {
  double value;    ///< R_r at finite strain over the linear one, minus 1 [1]
  double scatter;  ///< standard deviation of that, by the pairs left out in turn [1]
};

/// @param linear  the scene's converged solution by a linear method
/// Empty where the formula was not fitted: spheres, several layers, coatings, half-spaces, a given approach, torque or
/// rotation, printed kinematics, elastic layers, mostly frictional resistance, beyond those ranges.
std::optional<LinearityError> linearity_error(const ContactModel& model, const RollingSolution& linear);

}  // namespace rollres
