#pragma once

/// What a grid does to the rolling resistance, told from one solution on it.
///
/// Slow rolling, of memories short against the contact: the resistance to second order in the speed
/// (core/newton/README.md, (N18)), which takes the place of the grid's own by a share that is smooth in all inputs, and
/// what the grid loses of it where memories are shorter than a cell, (N21).

#include "core/newton/contact_powers.hpp"
#include "core/newton/contact_problem.hpp"

namespace rollres {

struct GridError {
  static constexpr double of_unresolved = 0.3;  // of (N21), that counts in an estimate

  double slow_loss = 0;      ///< viscous resistance by (N18) [N] (per metre for a cylinder)
  double slow_time = 0;      ///< tau' of (N16), of memories that are not long beside the contact [s]
  double slow_pushed = 0;    ///< what of printed kinematics' unbalanced power is the pressure's, to first order [N]
  double slow_error = 0;     ///< estimated error of that [N]
  double unresolved = 0;     ///< estimated error of the grid's own, by (N21) [N]
  double slow_share = 0;     ///< how much of `slow_loss` to take: 0 to 1, smooth in all inputs
  double memory_length = 0;  ///< longest V tau [m]
  double steps = 0;          ///< `InfluenceTable::steps`

  /// Estimated error of a resistance [N], from `expected_change` (N22). Where the viscous loss is that of slow rolling,
  /// a finer grid changes friction's part and the load that is found alone, by `open_still` or so.
  double estimate(double resistance, double change, double open_still) const;
};

/// What finer grids may still change in a resistance [N]: what the last halving of the spacing changed, with a part of
/// what was expected before it, as one change may be small by chance (the contact's edges move by whole cells). Either
/// is NaN where there was none. Calibrated on random scenes (`rollres accuracy --random`), cylinders and spheres apart.
/// Of a sphere it is the change itself.
double expected_change(int dimension, double last, double before);

/// How far a sphere's edge between its nodes is known, which leaves less of a grid's error.
struct EdgeTrust {
  double pressure = 0;  ///< of the correction by its pressure (edge_correction.hpp), 0 to 1
  double slip = 0;      ///< the same of the slip at it: less on compressible layers (core/newton/README.md, section 8)
  double unresolved = 0;  ///< of GridError [N]
};

/// @param trust of the correction by the pressure
EdgeTrust edge_trust(const ContactModel& model, double trust, const GridError& error);

/// The same at the end. How much resultants and losses differ (N15) tells more than one or two grids alone, and what
/// friction takes falls with the spacing, the viscous loss faster. Of a sphere the number of cells tells most, as its
/// error is the chance by which cells meet the edge.
double expected_change(int dimension, double last, double before, const ContactPowers& powers,
                       const EdgeTrust& edge = {});

/// The same of a cylinder on tied grids (grid_series.hpp), where changes are regular, and how quickly they fall tells
/// what is to come; where nodes stick, friction's power is open by what half a cell is to it (N22b).
double expected_change_of_tied_line(double last, double before, const ContactPowers& powers);

/// What of these changes the slip between the nodes may make alone [N]: of slip zones narrower than a cell the grid
/// knows no more.
double open_friction(int dimension, const ContactPowers& powers);
/// And the load of a sphere alone that is found under a given approach, as R_r goes with it [N].
double open_load(int dimension, const ContactPowers& powers);

/// Much friction reduces the share of slow rolling. @param pressure on the problem's (half) grid [Pa]
GridError grid_error(const ContactProblem& problem, const Vector& pressure, const std::vector<Zone>& zone,
                     const ContactPowers& powers);

/// Puts the slow-rolling resistance into a solution, by its share: R_r, what drives it, and the viscous loss.
/// Shear tractions add to (N18) as in (N20).
void take_slow_rolling(const ContactModel& model, const GridError& error, const ContactPowers& powers,
                       RollingSolution& solution);

}  // namespace rollres
