#pragma once

/// One grid with all that belongs to it: the discretised problem, its coefficients, its operator, its solution.

#include <memory>
#include <optional>

#include "core/estimate/contact_estimate.hpp"
#include "core/newton/contact_powers.hpp"
#include "core/newton/grid_error.hpp"
#include "core/newton/newton_contact.hpp"

namespace rollres {

struct ContactLevel {
  std::unique_ptr<ContactProblem> problem;
  std::unique_ptr<InfluenceTable> table;
  std::unique_ptr<InfluenceOperator> influence;
  NewtonOutcome outcome;
  ContactPowers powers;
  GridError error;
  EdgeCorrection edge;  // of the finest grid alone
};

/// A level without a solution yet.
ContactLevel make_level(const ContactModel& model, const SurfaceGrid& grid);

/// Pressure like an elliptical dome over the estimated contact, without shear. With adhesion the contact peels from the
/// widest one, so that the whole window begins in contact.
ContactUnknowns first_guess(const ContactProblem& problem, const ContactEstimate& estimate);

/// The solution of a level, interpolated to a finer grid.
ContactUnknowns transfer(const ContactLevel& from, const SurfaceGrid& to);

/// Grid with the spacings and the origin of `like` that leaves `margin` [m] around the level's contact.
SurfaceGrid follow(const ContactLevel& level, const SurfaceGrid& like, double margin);

/// Where the contact reaches the end of a profile [m]: there the pressure has no bound, and the grid decides it.
std::optional<double> end_in_contact(const ContactLevel& level);

/// The residual at which gaps are met beside the body's height, too. Laws are counted in pressure, by what a node
/// yields to itself: of a layer far thinner than the contact is long a long wave yields far less, and a small pressure
/// is a gap.
double residual_of_gaps(const ContactLevel& level, const ContactEstimate& estimate);

}  // namespace rollres
