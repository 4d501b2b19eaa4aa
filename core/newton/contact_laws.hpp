#pragma once

/// The laws of contact (N4) and (N5) as one equation of natural maps (Alart and Curnier 1991; Christensen et al. 1998),
///   p = max(0, p - gap/kappa),   tau = Proj_disc(mu p)(tau + slip/sigma),   load and drive rows,
/// with kappa and sigma the response of a node to itself (core/newton/README.md, (N6)): how far they are violated, and
/// which branch of them holds at each node.

#include <vector>

#include "core/newton/newton_system.hpp"

namespace rollres {

/// Nodes in contact, by one flag for each node of the (half) grid.
using ContactMask = std::vector<char>;

/// Residuals of the natural maps at all nodes, the evidence of a solution [Pa].
struct NaturalMaps {
  Displacements moved;
  Vector gap;              // profile - d - w [m]
  Vector slip_x, slip_y;   // slip / V (N2) [1], at every node
  CoatingMoments coating;  // where the drive's row has them
  double largest = 0;      // largest residual of any law over the largest pressure [1]
  double mean_square = 0;  // sum of squares of the residuals over the squared largest pressure
};

NaturalMaps natural_maps(const ContactProblem& problem, const InfluenceOperator& influence, const ContactUnknowns& x,
                         const ContactMask& in_contact);

/// Nodes with traction.
ContactMask loaded_nodes(const ContactUnknowns& x);

/// Contact set by the normal law; a node in contact stays until its tension passes the adhesion threshold.
ContactMask choose_contact(const ContactProblem& problem, const InfluenceOperator& influence, const ContactUnknowns& x,
                           const NaturalMaps& maps, const ContactMask& before);

/// Stick or slip at the nodes in contact by the law of friction, linearised as in (N7). A cylinder whose rotation is
/// unknown keeps at least one sticking node, without which the drive could not determine the rotation.
ActiveLaws choose_laws(const ContactProblem& problem, const InfluenceOperator& influence, const ContactUnknowns& x,
                       const NaturalMaps& maps, const ContactMask& contact, bool all_stick = false);

/// What the active laws miss: the right sides of (N8).
LawResiduals law_residuals(const ContactProblem& problem, const InfluenceOperator& influence, const ContactUnknowns& x,
                           const NaturalMaps& maps, const ActiveLaws& laws);

}  // namespace rollres
