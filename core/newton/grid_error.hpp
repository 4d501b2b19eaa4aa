#pragma once

/// What a grid does to the rolling resistance, told from one solution on it.
///
/// Edges: the gaps beside the contact, core/newton/README.md, (N15). Slow rolling, of memories short against the
/// contact: the resistance to second order in the speed, (N18), which takes the place of the grid's own by a share that
/// is smooth in all inputs, and what the grid loses of it where memories are shorter than a cell, (N21).

#include "core/newton/contact_powers.hpp"
#include "core/newton/contact_problem.hpp"

namespace rollres {

struct GridError {
  bool lateral = false;      ///< a contact with an edge all around
  double edges = 0;          ///< Delta of (N15) [N] (per metre for a cylinder)
  double slow_loss = 0;      ///< viscous resistance by (N18) [N]
  double slow_error = 0;     ///< estimated error of that [N]
  double unresolved = 0;     ///< estimated error of the grid's own, by (N21) [N]
  double slow_share = 0;     ///< how much of `slow_loss` to take: 0 to 1, smooth in all inputs
  double memory_length = 0;  ///< longest V tau [m]

  /// Estimated error of a resistance, from what the last halving of the spacing changed in it [N]; that may be NaN
  /// (N22).
  double estimate(double resistance, double last_change) const;
};

/// @param pressure [Pa] and gap [m] on the problem's (half) grid
GridError grid_error(const ContactProblem& problem, const Vector& pressure, const std::vector<Zone>& zone,
                     const Vector& gap);

/// Puts the slow-rolling resistance into a solution, by its share, which much friction reduces: R_r, what drives it,
/// and the viscous loss. Shear tractions add to (N18) as in (N20).
void take_slow_rolling(const RollingScene& scene, GridError& error, const ContactPowers& powers,
                       RollingSolution& solution);

}  // namespace rollres
