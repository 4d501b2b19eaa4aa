#pragma once

/// What the linear theory misses of a cylinder's rolling resistance where displacements and strains are not small.
///
/// With R_r at finite strain as core/finite_strain/README.md defines it (neo-Hooke, overstresses linear in the second
/// Piola-Kirchhoff stress; another law of finite viscoelasticity gives another number) and the linear one under the
/// same load or the same approach,
///   ln(R_r finite / R_r linear) = d/H b,
/// b running between four limits: of thick and thin layers by A = a/(a + H), of frequencies far above the peak of loss
/// and far below it by U = (1 + d ln G''/d ln omega)/2, plus what compressible layers add below the peak, U (1 - 2 nu)
/// times a factor, and lossy ones, tan delta/(1 + tan delta) times a factor; a is half the length of the contact, G''
/// and tan delta are those at omega = V/a. Of rings with friction (a/R)(R_r/P) times a factor is added. The factors are
/// fitted to drawn pairs of solutions (tests/benchmark/linearity.py draws and fits them), layers on a rigid base and
/// rings on a rigid core: 0.02 < a/H < 5, d/H < 0.33, nu >= 0.35, mu <= 0.8, Zener and Prony solids. On half-spaces no
/// pair with a/R < 0.6 differed by more than 0.15 a/R.

#include <optional>

#include "core/model/contact_model.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

struct LinearityError {
  double value;    ///< R_r at finite strain over the linear one, minus 1 [1]
  double scatter;  ///< standard deviation of that, by the pairs left out in turn [1]
};

/// @param linear  the scene's converged solution by a linear method
/// Empty where the formula was not fitted: spheres, several layers, a coating beside a foundation that yields, a given
/// torque or rotation, printed kinematics, elastic layers, mostly frictional resistance, beyond those ranges.
std::optional<LinearityError> linearity_error(const ContactModel& model, const RollingSolution& linear);

/// d/H, H the thickness of the only layer that yields, or of all layers where several do [1]; NaN without an approach
/// or over a half-space.
double strain_number(const ContactModel& model, const RollingSolution& solution);

}  // namespace rollres
