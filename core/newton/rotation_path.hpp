#pragma once

/// The solutions of a contact problem as a path in the rotation ratio omega.
///
/// It runs from the body that slides backwards (omega -> -infinity) to the one that spins forwards (+infinity); why one
/// exists for every omega, and where it folds back, stands in core/newton/README.md, section 5. Within one set of
/// active laws it is smooth (a cylinder's straight); folds are mostly kinks, where a node changes its law.
///
/// The path is followed by steps in omega. Where the Newton method fails it goes along the tangent to the next kink,
/// where the first node changes its law, and on along the tangent of the new laws, in whatever direction omega then
/// moves: for a cylinder these are the pivots of a parametric linear complementarity problem.

#include <optional>

#include "core/newton/contact_level.hpp"

namespace rollres {

class RotationPath {
 public:
  /// @param problem the level's, or one with another drive or friction on the same grid
  /// @param frictionless tractions without friction, from which a first solution is sought at several rotations
  RotationPath(const ContactProblem& problem, const ContactLevel& level, const ContactUnknowns& frictionless,
               const NewtonOptions& options);

  bool started() const { return here_.converged; }
  const NewtonOutcome& here() const { return here_; }
  double ratio() const { return here_.unknowns.rotation_ratio; }
  /// Goes the way in which omega grows (1) or falls (-1) at first: by steps in omega, fast, or by pivots, surely.
  void set_direction(int direction, bool pivoting) {
    direction_ = direction;
    pivoting_ = pivoting;
    tangent_.reset();
  }
  int direction() const { return direction_; }
  /// Goes on to another point, but not beyond `limit` if omega passes that. False at a dead end.
  bool advance(double limit);

  /// The solution at a given rotation, if the Newton method finds it from the start given.
  std::optional<NewtonOutcome> solve_at(double ratio, const ContactUnknowns& start) const;

  bool pivoting() const { return pivoting_; }
  int iterations() const { return iterations_; }

 private:
  bool step(double limit);
  bool pivot(double limit);
  struct Change {
    double amount;  // along the tangent
    ActiveLaws laws;
  };
  /// Where the laws first change along the tangent, and into which; nothing where they never do.
  std::optional<Change> first_change(const ActiveLaws& old_laws) const;
  /// Moves part of the way to the kink; not further off the tangent than `reach` times that.
  bool step_along_tangent(double amount, double reach);
  /// The solution near a predicted one, as far along the tangent; no other branch within `reach` of the largest
  /// traction.
  std::optional<NewtonOutcome> correct(const ContactUnknowns& predicted, double reach);
  ActiveLaws laws_at(const ContactUnknowns& x) const;
  std::optional<ContactUnknowns> tangent(const ActiveLaws& laws, const ContactUnknowns& measure);

  const ContactLevel* level_;
  NewtonOptions options_;
  ContactProblem turning_;  // rotation given
  ContactProblem freely_;   // rotation unknown, the drive's row a measure of progress
  NewtonOutcome here_;
  std::optional<ContactUnknowns> tangent_;  // after a pivot
  int direction_ = 1;
  double step_;  // in omega
  bool pivoting_ = false;
  mutable int iterations_ = 0;
};

}  // namespace rollres
