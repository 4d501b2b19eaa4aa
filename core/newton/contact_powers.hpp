#pragma once

/// Where the power goes, told from the fields of a solution on a grid, and the rolling resistance that follows from it
/// (core/newton/README.md, section 7).

#include <algorithm>
#include <cmath>

#include "core/convolution/influence_operator.hpp"
#include "core/edge/edge_correction.hpp"
#include "core/newton/contact_problem.hpp"
#include "core/newton/law_rows.hpp"
#include "core/newton/newton_system.hpp"

namespace rollres {

/// What a power balance may miss of R_r whatever the error stated; beyond, an estimate is at least that.
constexpr double trusted_balance = 0.01;

/// Largest violation of a law of contact that an answer may have, relative.
constexpr double trusted_violation = 1e-8;

/// Resistance over the moment of the load's halves below which the layer is as good as elastic: then it is rounding and
/// the grid's.
constexpr double negligible_resistance = 1e-3;

/// Powers over V [N] (per metre for a cylinder).
struct ContactPowers {
  double layer = 0;         ///< what the layers take: p w' - tau . (u', v'), slopes by central differences; a coating
                            ///< flows at R Omega, a ring takes tau w/R less
  CoatingMoments coating;   ///< M of (N3b) and N of (N3e)
  double friction = 0;      ///< what friction takes: tau . slip, with the same slopes
  double by_law = 0;        ///< the same with the slip of the law, by forward differences: 0 at nodes that stick
  double unbalanced = 0;    ///< of the kinematics, (N23): 0 where they are consistent
  double pushed = 0;        ///< of that, the pressure's
  double resultants = 0;    ///< Q + T Omega/V
  double edge = 0;          ///< what the edge between the nodes changes of them
  double halves = 0;        ///< int p |x|/R, the moment of the load's two halves, whose difference the resultants are
  double share = 0;         ///< of the losses in `resistance`, 0 to 1, smooth in all inputs
  double sticking = 0;      ///< part of the load that sticking nodes bear [1]
  double drawn = 0;         ///< tangential force over what friction bears at most: 1 where all slides one way [1]
  bool load_found = false;  ///< the approach is given
  double cells = 0;         ///< on the radius of a circle of as many cells as a sphere's contact has [1]

  double losses() const { return layer + friction + unbalanced; }
  /// By which the balance misses: Delta of (N15).
  double missing() const { return std::abs(resultants - losses()); }
  /// What half a cell is to friction's power: slip on one side of the nodes against slip at them. Falls like the
  /// spacing.
  double half_cell() const { return std::abs(friction - by_law); }
  /// How far zones of slip are wider than cells: 1 where half a cell is less than half of friction's power, 0 where it
  /// is all of it.
  double slip_resolved() const {
    return half_cell() < std::abs(friction) ? std::min(1.0, 2 - 2 * half_cell() / std::abs(friction)) : 0;
  }
  /// How far shear tractions are open: at nodes that stick, or that slip in directions of their own [1].
  double open_shear() const { return std::max(sticking, 1 - drawn); }
  /// R_r: by the resultants, or by the losses where the resultants cancel.
  double resistance() const { return resultants + edge + share * (losses() - resultants - edge); }
  /// With the edge the resultants are right to smaller differences (README.md, (N32)).
  void take(const EdgeCorrection& correction);
  /// What errors of a rolling resistance are measured by: an elastic layer resists with nothing.
  double scale(double of_resistance) const { return std::max(std::abs(of_resistance), 1e-6 * halves); }
  double scale() const { return scale(resistance()); }
};

/// @param coating its part of the displacements; empty without one
/// @param moved u and v may be empty without friction   @param zone of every node of the problem's (half) grid
ContactPowers contact_powers(const ContactProblem& problem, const Displacements& moved, const Displacements& coating,
                             const ContactUnknowns& unknowns, const std::vector<Zone>& zone);

// What a coating takes: M of (N3b) and N of (N3e), and what the linearised drive has of them.

/// The coating's part of the displacements; empty without one.
Displacements moved_coating(const InfluenceOperator& influence, const ContactUnknowns& x);

/// M = sum A p c_x, c_x by central differences, so that an elastic coating takes nothing by itself, and of a ring N =
/// sum A tau_x c/R, c the coating's part of w; 0 without one.
CoatingMoments coating_moments(const ContactProblem& problem, const InfluenceOperator& influence,
                               const ContactUnknowns& x);

/// The derivative of what the drive's row has of them; empty where it has nothing.
TractionRow coating_in_drive_row(const ContactProblem& problem, const InfluenceOperator& influence,
                                 const ContactUnknowns& x);

/// The derivative of M and N, each times its factor. @pre there is a coating
TractionRow moments_row(const ContactProblem& problem, const InfluenceOperator& influence, const ContactUnknowns& x,
                        const CoatingMoments& factors);

/// Changes a solution's rolling resistance, and what drives the body with it.
void add_resistance(const ContactModel& model, double change, RollingSolution& solution);

}  // namespace rollres
