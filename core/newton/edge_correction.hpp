#pragma once

/// What the edge between the nodes changes of a sphere's rolling resistance (README.md, section 9).

#include "core/convolution/influence_operator.hpp"
#include "core/newton/contact_powers.hpp"
#include "core/newton/contact_problem.hpp"
#include "core/newton/newton_system.hpp"

namespace rollres {

/// If the pressure of even cells becomes one that is spread like the root of the distance to the edge, under the same
/// load, shear and rotation.
struct EdgeCorrection {
  double change = 0;  ///< of the resultants' rolling resistance [N]
  double trust = 0;   ///< from 0, none, to 1: how well the edge and the pressure agree

  /// Rolling resistance with it [N].
  double resistance(const ContactPowers& powers) const;
};

/// None for a cylinder, the paper's kinematics, adhesion, a given approach, or where no edge is found with which the
/// pressure agrees. @param x solution on even cells
EdgeCorrection edge_correction(const ContactProblem& problem, const InfluenceOperator& influence,
                               const ContactUnknowns& x);

}  // namespace rollres
