#pragma once

/// Coupled semi-smooth Newton method for rolling contact with stick and slip.
///
/// All laws, as one equation of natural maps (contact_laws.hpp), are solved for (p, tau_x, tau_y, d, omega) at once:
/// each step holds the contact, stick and slip sets that the maps choose, solves the linearised laws, and is shortened
/// where the norm of the maps does not fall. Theory: core/newton/README.md, sections 2 to 4.

#include "core/newton/contact_laws.hpp"

namespace rollres {

struct NewtonOptions {
  bool dense = false;  ///< factorise always; otherwise only systems up to `dense_unknowns`
  int dense_unknowns = 200;
  int factorisable_unknowns = 2000;  ///< and those up to here where GMRES fails
  double tolerance = 2e-10;  ///< largest violation of a law, relative to the largest pressure (shear: to mu times it)
  int most_iterations = 60;
  bool first_all_stick = false;  ///< whether the first step holds every contact node sticking
};

struct NewtonOutcome {
  ContactUnknowns unknowns;
  std::vector<Zone> zone;  // on the whole (half) grid
  Vector gap;              // profile - d - w [m]
  bool converged = false;
  int iterations = 0, krylov_iterations = 0;
  double residual = 0;  // largest violation, relative to the largest pressure
  bool reached_border = false;
};

/// @param start its contact set is where its pressure is not zero
NewtonOutcome newton_contact(const ContactProblem& problem, const InfluenceTable& table,
                             const InfluenceOperator& influence, const ContactUnknowns& start,
                             const NewtonOptions& options);

}  // namespace rollres
