#pragma once

/// Coupled semi-smooth Newton method for rolling contact with stick and slip.
///
/// All laws, as one equation of natural maps (contact_laws.hpp), are solved for (p, tau_x, tau_y, d, omega) at once:
/// each step holds the contact, stick and slip sets that the maps choose, solves the linearised laws, and is shortened
/// where the norm of the maps does not fall. Theory: core/newton/README.md, sections 2 to 4.

#include "core/newton/contact_laws.hpp"

namespace rollres {

/// The numbers that tune the method, and when one would change them. None changes an answer beyond `tolerance`.
struct NewtonOptions {
  /// Largest violation of a law, relative to the largest pressure (shear: to mu times it). Rounding allows 1e-11.
  double tolerance = 2e-10;
  /// The same on grids that only give a start, or R_r for an estimate of the error.
  double start_tolerance = 1e-8;

  // The linear step. Larger systems are worth factorising where the processor multiplies matrices fast.
  bool dense = false;                ///< factorise always; otherwise only systems up to `dense_unknowns`
  int dense_unknowns = 200;          ///< where factorising takes as long as GMRES
  int factorisable_unknowns = 2000;  ///< up to here also where GMRES fails: what a user waits for
  int most_krylov_vectors = 300;     ///< of GMRES, which keeps them all: memory
  /// Bounds of its tolerance (N9): the largest as long as steps with it converge, the least above single precision.
  double least_forcing = 1e-5, most_forcing = 2e-2;

  // The steps.
  int most_iterations = 60;          ///< scenes that converge take below 15; of those left some need patience
  double rounded = 5e-9;             ///< residual that will do where steps no longer lessen it
  int most_stays = 4;                ///< such steps
  int refining_iterations = 20;      ///< the same on a grid finer than one that gave an answer
  bool first_all_stick = false;      ///< whether the first step holds every contact node sticking
  std::size_t remembered_steps = 4;  ///< whose largest norm a step may reach: more lets sets change, fewer is safer
  int idle_steps = 6;           ///< that do not halve the least residual, after which a step reaches the last alone
  int most_idle_steps = 12;     ///< of an iteration along an edge: such steps rarely end
  double shortest_step = 0.05;  ///< part of a step below which it is not shortened
  /// Residuals between which the edge follows the pressure: above, contacts change; below, it moves R_r by 1e-9.
  double edge_follows = 1e-2, edge_rests = 1e-6;

  // The path over the rotation (rotation_path.hpp).
  int path_iterations = 20;  ///< for one point: a step in omega that needs more is too long
  double first_turn = 1e-3;  ///< first step in omega: the strains under the body, which scale the creepage
  double turn_growth = 3;    ///< of the steps that succeed
  double end_of_path = 1e6;  ///< in omega, where everything slides
  int most_points = 3000;    ///< on the path: kinks of some hundred nodes, several times
};

struct NewtonOutcome {
  ContactUnknowns unknowns;
  std::vector<Zone> zone;  // on the whole (half) grid
  Vector gap;              // profile - d - w [m]
  Displacements moved;     // of all nodes; u and v empty without friction
  bool converged = false;
  int iterations = 0, krylov_iterations = 0;
  double residual = 0;  // largest violation, relative to the largest pressure
  bool reached_border = false;
};

/// @param start its contact set is where its pressure is not zero
NewtonOutcome newton_contact(const ContactProblem& problem, const InfluenceTable& table,
                             const InfluenceOperator& influence, const ContactUnknowns& start,
                             const NewtonOptions& options);

/// The same where the problem's edge, if it is known, follows the pressure (core/newton/README.md, section 8).
NewtonOutcome newton_along_edge(ContactProblem& problem, const InfluenceTable& table,
                                const InfluenceOperator& influence, const ContactUnknowns& start,
                                const NewtonOptions& options);

}  // namespace rollres
