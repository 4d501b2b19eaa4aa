#pragma once

/// From tractions to a solution: fields, resultants, losses, and how well every law of contact holds.
///
/// Nothing here comes from a method's own residual: displacements and slip are recomputed from the tractions and the
/// influence coefficients. The laws are checked against the zone that the method claims for each node:
///   free:   p = tau = 0 and no penetration;
///   stick:  gap = 0, no tension beyond the adhesion threshold, |tau| <= mu |p|, slip = 0;
///   slip:   gap = 0, |tau| = mu |p|, tau |slip| = mu |p| slip;
/// and the load and the drive by their sums. Gaps are measured by l^2/(2R) (l half the contact's length), slips by
/// l/R, pressures by the largest pressure p0, shear by mu p0, forces by the load; `law_violation` is the largest.
///
/// Power balance: contact_powers.hpp. `energy_residual` compares what the drive gives, Q V + T Omega, with what the
/// layers and friction take by the fields; with printed kinematics, less the power that these leave over.

#include "core/convolution/influence_operator.hpp"
#include "core/newton/contact_powers.hpp"
#include "core/newton/contact_problem.hpp"
#include "core/newton/newton_system.hpp"
#include "core/scene/contact_state.hpp"

namespace rollres {

struct GridSolution {
  RollingSolution solution;
  ContactPowers powers;
};

/// All outputs but those that only the caller knows (status, reason, iterations, seconds, method, model, warnings,
/// error_estimate).
/// @param influence with all components, also without friction (the fields want u and v)
/// @param zone the method's claim for every node of the (half) grid   @param edge what R_r is corrected by
GridSolution summarise(const ContactProblem& problem, const InfluenceOperator& influence,
                       const ContactUnknowns& unknowns, const std::vector<Zone>& zone, const EdgeCorrection& edge = {});

}  // namespace rollres
